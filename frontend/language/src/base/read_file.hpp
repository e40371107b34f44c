// Reads whole files.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace language {

/// Places count bytes in 32 bits, and devices such as /dev/zero never end.
constexpr size_t kMostFileBytes = size_t{1} << 30;

/// Returns the bytes of a file; nothing if it cannot be read, is a folder, or is too large.
std::optional<std::string> read_file(const std::string& path);

}  // namespace language
