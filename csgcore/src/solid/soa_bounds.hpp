// SoA bounds: simple bounds of a group's members in structures of arrays, for vectors of float.
#pragma once

#include <cstdint>

namespace csgcore {

/// Vectors read up to so many entries beyond the last one of a row.
constexpr uint32_t kRowPadding = 16;

/// Balls, in world units.
struct BallRows {
  const float* x;
  const float* y;
  const float* z;
  const float* radius;
};

/// Rectangles on the screen, in pixels.
struct RectangleRows {
  const float* low_x;
  const float* high_x;
  const float* low_y;
  const float* high_y;
};

}  // namespace csgcore
