// The colours that "xkcd:dust" and its like name.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace language {

/// Returns 0xRRGGBB of a name in small letters, without "xkcd:".
std::optional<uint32_t> xkcd_color(std::string_view name);

}  // namespace language
