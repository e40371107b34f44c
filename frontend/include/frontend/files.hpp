// Reads inputs at one go, and writes outputs that appear whole or not at all.
#pragma once

#include <cstddef>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/file_text.hpp"

namespace frontend {

/// Returns how messages name an input: the path, or "standard input" for "-".
std::string input_name(const std::string& path);

/// Returns whether the path can be read only once: standard input, a pipe or a device.
bool is_read_once(const std::string& path);

/// Reads a file, or standard input for "-". Once `is_hopeless` returns true, the rest is not read
/// beyond `most_if_hopeless` bytes, and the result may be a start of the text that fails as the
/// whole would. Throws Error if the file is missing, is a folder, cannot be read, or is larger than
/// kMaxInputBytes; Stopped (stop.hpp) once `stop` is requested.
FileText read_file(const std::string& path, const IsHopeless& is_hopeless = {},
                   const std::stop_token& stop = {}, std::size_t most_if_hopeless = 0);

/// Reads a regular file, which ends. Throws Error for any other.
FileText read_regular_file(const std::string& path);

/// Reads an open descriptor to its end; `name` is for messages.
FileText read_descriptor(int descriptor, const std::string& name,
                         const IsHopeless& is_hopeless = {}, const std::stop_token& stop = {},
                         std::size_t most_if_hopeless = 0);

/// Throws Error if it can be told beforehand that `path` cannot be read as a file.
void check_input(const std::string& path);

/// An output to be written. The path "-" is standard output.
struct PendingOutput {
  std::string path;
  std::vector<std::byte> bytes;
};

/// Returns the bytes of the text, unchanged.
std::vector<std::byte> bytes_of(std::string_view text);

/// Throws Error if it can be told beforehand that `path` cannot be written. To be called before any
/// work is spent on the output.
void check_output(const std::string& path);

/// A path as the user gave it, with its role.
struct NamedPath {
  std::string role;  // for messages: "-o", "the design"
  std::string path;  // "-" is standard output, or standard input
};

/// Throws Error if an output is the same file as another output or as an input: by its name or by
/// any link, also if the file does not exist yet. Only regular files must differ.
void check_outputs_differ(std::span<const NamedPath> outputs, std::span<const NamedPath> inputs);

/// Writes all outputs or none. Each regular file is first written under another name in its folder.
/// Only when all are written are they renamed, so that a failure leaves old files untouched and no
/// new ones. If a folder takes no new file, the old file is overwritten in place, and restored
/// after a failure. A symbolic link is followed and stays; devices and pipes are written to
/// directly. Throws Error.
void write_outputs(std::span<const PendingOutput> outputs);

}  // namespace frontend
