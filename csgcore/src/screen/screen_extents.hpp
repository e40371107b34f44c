// The bounds of primitives on the screen and in depth, per frame: the extents by which tiles are
// divided.
#pragma once

#include <limits>
#include <span>

#include "csgcore/canonical_primitive.hpp"
#include "rays/frame_rays.hpp"
#include "solid/extent_tests.hpp"

namespace csgcore {

/// In screen space, x and y are in pixels as pixel_ray counts them (whole numbers are pixels'
/// centres), and z is the ray parameter t. Bounds are conservative: no ray meets the primitive
/// outside of its box.
/// A primitive that no ray can meet lies outside of every cell (is_visible).
/// An extent with inside2 < 0 has a slab, and possibly a k-DOP (screen_slab.hpp), which may find
/// its primitive outside of a tile that its box meets.
struct ScreenOptions {
  /// True: rays go through pixels' centres only, and no ray meets a primitive that lies between
  /// them.
  bool centers_only = true;
};

/// Finds the extents on the screen of world[i], for each i in `indices`, and stores them in
/// screen[i].
void find_screen_extents(const Extent* world, std::span<const uint32_t> indices,
                         const FrameRays& frame, const ScreenOptions& options, Extent* screen);

/// A rectangle on the screen. An empty one (low > high) is met by no ray.
struct ScreenRectangle {
  double low_x, high_x, low_y, high_y;
  bool is_empty() const { return low_x > high_x || low_y > high_y; }
};

/// Finds conservative rectangles of balls, in float. The balls' centres are relative to `center`,
/// which is in world space. `rows` get `count` floats each: low x, high x, low y and high y. The
/// rectangles of balls that lie behind the eye, beside the picture or between the rays are empty.
/// Returns a rectangle that holds all others.
ScreenRectangle find_rectangles(const BallRows& balls, uint32_t count, const Vec3& center,
                                const FrameRays& frame, const ScreenOptions& options,
                                float* const (&rows)[4]);

/// Sets the extent's x and y, and whether it is visible, to those of a rectangle.
void set_rectangle(const ScreenRectangle& pixels, const View& view, Extent& screen);
/// Does the same with the intersection of the rectangle and the extent's own.
void narrow(const ScreenRectangle& to, const View& view, Extent& screen);

/// Returns false if no ray can meet the primitive: it is beside the picture, or between the rays.
inline bool is_visible(const Extent& screen) {
  return screen.half[0] != -std::numeric_limits<double>::infinity() && screen.outside2 >= 0;
}

/// Returns the extent on the screen of all that rays meet of a solid with these bounds, which are
/// not empty.
Extent screen_extent_of(const Box& solid_bounds, const FrameRays& frame,
                        const ScreenOptions& options);

/// Returns the pixels that the extent reaches any point of.
PixelArea pixels_of(const Extent& screen, const View& view);

/// Returns whether the extent's rectangle meets an area of the screen, whose z is ignored.
inline bool overlaps(const Extent& screen, const Box& area) {
  bool result = true;
  for (const int axis : {0, 1}) {
    result &= screen.center[axis] - screen.half[axis] <= area.max[axis];
    result &= screen.center[axis] + screen.half[axis] >= area.min[axis];
  }
  return result;
}

/// Returns whether the extent's rectangle contains an area of the screen, whose z is ignored.
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
