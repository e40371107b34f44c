// Paths without links and dots.
#pragma once

#include <filesystem>

namespace language {

/// Returns a path without `.` and `..`, and without links where it exists.
std::filesystem::path resolved(const std::filesystem::path& path);

/// The same, but a file that is a link itself keeps its name.
std::filesystem::path resolved_file(const std::filesystem::path& path);

}  // namespace language
