// What is kept of a group's members side by side, for vectors of float.
#pragma once

#include <cstdint>

namespace csgcore {

/// Vectors read so far beyond a row's last entry.
constexpr uint32_t kRowPadding = 16;

/// Balls, in units of the world.
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
