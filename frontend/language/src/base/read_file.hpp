// Reads whole files, and resolves paths.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace language {

/// Places count bytes in 32 bits, and devices such as /dev/zero never end.
constexpr size_t kMostFileBytes = size_t{1} << 30;

/// Returns the bytes of a file; nothing if it cannot be read, is a folder, or is too large.
std::optional<std::string> read_file(const std::string& path);

/// Returns whether a path, with its links followed, leads to a file that is no pipe, device or
/// folder: to one that ends, and is there at once.
bool is_regular_file(const std::string& path);
/// The same as read_file(); nothing if the file is not regular.
std::optional<std::string> read_regular_file(const std::string& path);

/// Returns a path without `.` and `..`, and without links where it exists.
std::filesystem::path resolved(const std::filesystem::path& path);

/// The same, but a file that is a link itself keeps its name.
std::filesystem::path resolved_file(const std::filesystem::path& path);

}  // namespace language
