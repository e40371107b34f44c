// Pictures that programs have written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace measure {

/// 8 bits a channel, three channels a pixel, row by row from the top.
struct Png {
  uint32_t width_px = 0;
  uint32_t height_px = 0;
  std::vector<uint8_t> rgb;
  bool operator==(const Png&) const = default;
};

/// Any PNG as RGB. Throws std::runtime_error.
Png read_png(const std::filesystem::path& file);

/// All of its pixels have one colour.
bool is_blank(const Png& picture);

}  // namespace measure
