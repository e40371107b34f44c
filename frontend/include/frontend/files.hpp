// Files in and out: a design read in one go; pictures that appear whole or not at all.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace frontend {

/// A file's text, a copy of its own: a file that changes while it is read cannot harm us.
class FileText {
 public:
  FileText() = default;
  FileText(std::unique_ptr<char[]> bytes, std::size_t size)
      : bytes_(std::move(bytes)), size_(size) {}
  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

/// Reads a file, or standard input for "-". Throws Error where that is missing, a folder, cannot be
/// read, or is larger than kMaxInputBytes; Stopped (stop.hpp) where `stop` asks for it.
FileText read_file(const std::string& path, const std::stop_token& stop = {});

/// Reads an open descriptor to its end; `name` is for messages.
FileText read_descriptor(int descriptor, const std::string& name, const std::stop_token& stop = {});

/// Locations and offsets in a syntax tree are 32 bits wide.
constexpr std::size_t kMaxInputBytes = 0xFFFFFFFFu;

/// What is to be written: `path` "-" is standard output.
struct PendingOutput {
  std::string path;
  std::vector<std::byte> bytes;
};

/// A text, to be written as it is.
std::vector<std::byte> bytes_of(std::string_view text);

/// Throws Error if `path` can be seen not to be writable, before any work is spent on it.
void check_output(const std::string& path);

/// Writes all outputs: each regular file first under another name in its folder, and only once all
/// are written are they renamed, so that a failure leaves old files untouched and no new ones. A
/// symbolic link is followed and stays; devices and pipes are written to directly. Throws Error.
void write_outputs(std::span<const PendingOutput> outputs);

}  // namespace frontend
