// Where shapes that fill their boxes badly, and all large ones, lie on the screen.
#pragma once

#include <cmath>

#include "screen/screen_extents.hpp"

namespace csgcore {

/// Two lines of the screen that a primitive lies between: no ray through a point p, in pixels as
/// pixel_ray counts them, with x·p.x + y·p.y > limit for either line meets it. (x, y) is of length
/// 1; or 0 and the limit +∞, where there is no such line.
struct alignas(32) ScreenSlab {
  float x[2], y[2], limit[2];
};

/// Whether no ray through the tile (a box in screen space; its z does not count) meets what lies
/// between the lines.
inline bool misses(const ScreenSlab& slab, const Box& tile) {
  const auto middle = [&](int axis) {
    return static_cast<float>(0.5 * (tile.min[axis] + tile.max[axis]));
  };
  const auto half = [&](int axis) {
    return static_cast<float>(0.5 * (tile.max[axis] - tile.min[axis]));
  };
  bool result = false;
  for (const int line : {0, 1}) {
    const float x = slab.x[line];
    const float y = slab.y[line];
    const float nearest =
        (x * middle(0) - std::abs(x) * half(0)) + (y * middle(1) - std::abs(y) * half(1));
    result |= nearest > slab.limit[line];
  }
  return result;
}

/// What a large primitive leaves of its rectangle's corners: no ray through a point p, in pixels,
/// meets it where d·p < low or d·p > high for any of kCornerDirections.
struct ScreenKDop {
  static constexpr int kCount = 6;
  float low[kCount], high[kCount];
};
constexpr float kCornerDirections[ScreenKDop::kCount][2] = {{1, 1},  {1, -1}, {2, 1},
                                                            {2, -1}, {1, 2},  {1, -2}};

/// The same of what lies within the corners' limits.
inline bool misses(const ScreenKDop& corners, const Box& tile) {
  const float from[] = {static_cast<float>(tile.min.x), static_cast<float>(tile.min.y)};
  const float to[] = {static_cast<float>(tile.max.x), static_cast<float>(tile.max.y)};
  bool result = false;
  for (int i = 0; i < ScreenKDop::kCount; ++i) {
    const auto [x, y] = kCornerDirections[i];
    const bool rises = y > 0;
    result |= x * from[0] + y * (rises ? from[1] : to[1]) > corners.high[i];
    result |= x * to[0] + y * (rises ? to[1] : from[1]) < corners.low[i];
  }
  return result;
}

/// Smaller ones on the screen have no ScreenKDop.
constexpr double kCorneredHalf_px = 32;

/// The inside2 of an extent whose primitive has them.
constexpr double kCornered = -2;

/// For each of the indices: narrows the primitive's extent on the screen, which was found from its
/// box, to the shape itself, or to what encloses a polyhedron of many vertices; and finds lines
/// that it lies between, and of a large one the corners, which its inside2 tells then. For
/// primitives on the screen only.
void find_slabs(const CanonicalPrimitive* primitives, std::span<const uint32_t> indices,
                const FrameRays& frame, const ScreenOptions& options, Extent* screen,
                ScreenSlab* slabs, ScreenKDop* corners);

}  // namespace csgcore
