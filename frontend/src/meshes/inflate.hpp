// Unpacks what deflate has packed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace frontend {

enum class Wrapping : uint8_t { kNone, kZlib };

/// Returns nothing if the data are damaged, or would unpack to more than `most_bytes`.
std::optional<std::string> inflate(std::string_view packed, Wrapping wrapping, size_t most_bytes);

}  // namespace frontend
