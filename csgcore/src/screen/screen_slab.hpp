// Screen slabs and k-DOPs: sharper bounds on the screen for primitives that fill their boxes badly,
// and for large ones.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "csgcore/canonical_primitive.hpp"
#include "rays/ray_packet.hpp"
#include "screen/screen_extents.hpp"

namespace csgcore {

/// A screen slab: two lines on the screen between which a primitive lies. No ray through a point p,
/// in pixels as pixel_ray counts them, with x·p.x + y·p.y > limit for either line meets the
/// primitive. (x, y) has length 1. If there is no such line, (x, y) is 0 and the limit +∞.
struct alignas(32) ScreenSlab {
  float x[2], y[2], limit[2];
};

/// Returns whether no ray through the tile (a box in screen space, whose z is ignored) meets the
/// region between the lines.
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

/// The k-DOP (discrete oriented polytope) of a large primitive on the screen, which cuts off the
/// corners of its rectangle. No ray through a point p, in pixels, with d·p < low or d·p > high for
/// any direction d of kCornerDirections meets the primitive.
struct ScreenKDop {
  static constexpr int kCount = 6;
  float low[kCount], high[kCount];
};
constexpr float kCornerDirections[ScreenKDop::kCount][2] = {{1, 1},  {1, -1}, {2, 1},
                                                            {2, -1}, {1, 2},  {1, -2}};

/// Returns whether no ray through the tile meets the region within all limits.
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

/// A primitive needs at least this half width or height on the screen for a ScreenKDop.
constexpr double kCorneredHalf_px = 32;

/// The inside2 of an extent that has a ScreenKDop besides its slab.
constexpr double kCornered = -2;

/// Sharpens the bounds of the primitives with these indices, which must lie on the screen. It
/// narrows the extent, which was found from the primitive's box, to the shape itself (or to the
/// enclosure of a polyhedron with many vertices), and finds the slab and, for large primitives, the
/// k-DOP. The extent's inside2 says which of them there are.
void find_slabs(const CanonicalPrimitive* primitives, std::span<const uint32_t> indices,
                const FrameRays& frame, const ScreenOptions& options, Extent* screen,
                ScreenSlab* slabs, ScreenKDop* corners);

/// Finds, by the bounds on the screen, the lanes that may meet each primitive (indices, whose top
/// bits are ignored) in the block whose top left pixel is (x, y), and in the block below it. It
/// uses the extents on the screen, which must not be NaN, and the slabs of primitives whose extent
/// has inside2 < 0. It holds for rays through pixels' centres only.
void find_reached(const Extent* screen, const ScreenSlab* slabs,
                  std::span<const uint32_t> primitives, uint32_t x, uint32_t y, LaneMask* above,
                  LaneMask* below);

}  // namespace csgcore
