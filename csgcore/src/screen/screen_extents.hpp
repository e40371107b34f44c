// Where primitives lie on the screen and in depth, per frame: the Extents that tiles are divided
// by.
#pragma once

#include <limits>
#include <span>

#include "csgcore/extent.hpp"
#include "rays/frame_rays.hpp"
#include "solid/extent_tests.hpp"
#include "solid/soa_bounds.hpp"

namespace csgcore {

/// Screen space: x and y in pixels as pixel_ray counts them (whole numbers are pixels' centres), z
/// is τ. Bounds are conservative: no ray meets the primitive outside of its box.
/// A primitive that no ray can meet is outside every cell: see cull_reason_on_screen.
/// inside2 < 0 marks what a closer look may find outside of a tile, and how (screen_slab.hpp).
struct ScreenOptions {
  /// Rays go through pixels' centres only: what lies between them is seen by none.
  bool centers_only = true;
};

/// Of the extents of these indices in `world`, into the same places of `screen`.
void find_screen_extents(const Extent* world, std::span<const uint32_t> indices,
                         const FrameRays& frame, const ScreenOptions& options, Extent* screen);

/// Empty (low > high): seen by none.
struct Rectangle {
  double low_x, high_x, low_y, high_y;
  bool is_empty() const { return low_x > high_x || low_y > high_y; }
};

/// Rectangles of balls, in float: conservative ones. `center`: of the world, what the balls count
/// from; `rows`: of `count` floats each, low x, high x, low y, high y. Those that are behind the
/// eye, beside the picture or between the rays are empty. Returns what holds all others.
Rectangle find_rectangles(const BallRows& balls, uint32_t count, const Vec3& center,
                          const FrameRays& frame, const ScreenOptions& options,
                          float* const (&rows)[4]);

/// Sets x and y, and what tells the cull_reason, to a rectangle.
void set_rectangle(const Rectangle& pixels, const View& view, Extent& screen);
/// The same to what of it the extent holds already.
void narrow(const Rectangle& to, const View& view, Extent& screen);

enum class ScreenCullReason : uint8_t { kVisible, kOffScreen, kSubPixel };
inline ScreenCullReason cull_reason_on_screen(const Extent& screen) {
  if (screen.half[0] == -std::numeric_limits<double>::infinity())
    return ScreenCullReason::kOffScreen;
  return screen.outside2 < 0 ? ScreenCullReason::kSubPixel : ScreenCullReason::kVisible;
}

/// Whether its rectangle meets an area of the screen, whose z does not count.
inline bool overlaps(const Extent& screen, const Box& area) {
  bool result = true;
  for (const int axis : {0, 1}) {
    result &= screen.center[axis] - screen.half[axis] <= area.max[axis];
    result &= screen.center[axis] + screen.half[axis] >= area.min[axis];
  }
  return result;
}

/// Whether its rectangle holds all of an area of the screen, whose z does not count.
inline bool covers(const Extent& screen, const Box& area) {
  bool result = true;
  for (const int axis : {0, 1}) {
    result &= screen.center[axis] - screen.half[axis] <= area.min[axis];
    result &= screen.center[axis] + screen.half[axis] >= area.max[axis];
  }
  return result;
}

inline double nearest_t(const Extent& screen) { return screen.center[2] - screen.half[2]; }
inline double furthest_t(const Extent& screen) { return screen.center[2] + screen.half[2]; }

}  // namespace csgcore
