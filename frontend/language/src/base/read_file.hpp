// Reads whole files.
#pragma once

#include <optional>
#include <string>

namespace language {

/// Returns the bytes of a file; nothing if it cannot be read, or is a folder.
std::optional<std::string> read_file(const std::string& path);

}  // namespace language
