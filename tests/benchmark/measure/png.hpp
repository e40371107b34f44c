// Reads pictures that programs have written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace measure {

/// A picture with 8 bits a channel and three channels a pixel, row by row from the top.
struct Png {
  uint32_t width_px = 0;
  uint32_t height_px = 0;
  std::vector<uint8_t> rgb;
  bool operator==(const Png&) const = default;
};

/// Reads any PNG as RGB. Throws std::runtime_error.
Png read_png(const std::filesystem::path& file);

/// Returns whether all pixels have one colour.
bool is_blank(const Png& picture);

}  // namespace measure
