// A picture in few colours.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "csgcore/image.hpp"

namespace frontend {

struct PalettePicture {
  std::vector<std::array<uint8_t, 3>> colors;  // 256 at most
  std::vector<uint8_t> pixels;                 // indices of colours
};

/// Returns the picture as it is if it has no more than 256 colours. Otherwise its colours are
/// divided where they differ most, at the mean, until there are so many groups, each of which gets
/// its mean: what fills much of the picture keeps its colour.
PalettePicture with_palette(const csgcore::Image& image);

}  // namespace frontend
