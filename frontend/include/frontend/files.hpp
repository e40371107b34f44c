// Files in and out: a design read in one go; pictures that appear whole or not at all.
#pragma once

#include <cstddef>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/file_text.hpp"

namespace frontend {

/// Reads a file, or standard input for "-". Where `is_hopeless` says so, the rest is not read: the
/// result is a start that is as useless as the whole. Throws Error where the file is missing, a
/// folder, cannot be read, or is larger than kMaxInputBytes; Stopped (stop.hpp) where `stop` asks
/// for it.
FileText read_file(const std::string& path, const IsHopeless& is_hopeless = {},
                   const std::stop_token& stop = {});

/// Reads an open descriptor to its end; `name` is for messages.
FileText read_descriptor(int descriptor, const std::string& name,
                         const IsHopeless& is_hopeless = {}, const std::stop_token& stop = {});

/// Throws Error if `path` can be seen not to be a file that can be read.
void check_input(const std::string& path);

/// What is to be written: `path` "-" is standard output.
struct PendingOutput {
  std::string path;
  std::vector<std::byte> bytes;
};

/// A text, to be written as it is.
std::vector<std::byte> bytes_of(std::string_view text);

/// Throws Error if `path` can be seen not to be writable, before any work is spent on it.
void check_output(const std::string& path);

/// A file as the user gave it.
struct NamedPath {
  std::string role;  // for messages: "-o", "the design"
  std::string path;  // "-" is standard output, or standard input
};

/// Throws Error if one of the outputs is the same file as another, or as one of the inputs: by its
/// name or by any link, also where it does not exist yet. What is no regular file may repeat.
void check_outputs_differ(std::span<const NamedPath> outputs, std::span<const NamedPath> inputs);

/// Writes all outputs: each regular file first under another name in its folder, and only once all
/// are written are they renamed, so that a failure leaves old files untouched and no new ones. An
/// old file whose folder takes no other is written in place, and put back after a failure. A
/// symbolic link is followed and stays; devices and pipes are written to directly. Throws Error.
void write_outputs(std::span<const PendingOutput> outputs);

}  // namespace frontend
