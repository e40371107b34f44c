// Where primitives lie on the screen and in depth, per frame: the Extents that tiles are divided
// by.
#pragma once

#include <vector>

#include "csgcore/extent.hpp"
#include "packet.hpp"

namespace csgcore {

/// Screen space: x and y in pixels as pixel_ray counts them (whole numbers are pixels' centres), z
/// is τ. Bounds are conservative: no ray meets the primitive outside of its box.
/// A primitive that no ray can meet is outside every cell: see fate_on_screen.
/// inside2 < 0 marks what a closer look may find outside of a tile (classify_in_tile).
struct ScreenOptions {
  /// Rays go through pixels' centres only: what lies between them is seen by none.
  bool centers_only = true;
};

/// Extents [begin, end) of `world`, into the same places of `screen`.
void find_screen_extents(const Extent* world, size_t begin, size_t end, const FrameRays& frame,
                         const ScreenOptions& options, Extent* screen);

enum class ScreenFate : uint8_t { kVisible, kOffScreen, kSubPixel };
ScreenFate fate_on_screen(const Extent& screen);

inline double nearest_t(const Extent& screen) { return screen.center[2] - screen.half[2]; }
inline double furthest_t(const Extent& screen) { return screen.center[2] + screen.half[2]; }

/// A primitive's support along the normals of planes through the eye and a line of the screen: what
/// tells, for a tile, that no ray through it meets the primitive. For shapes that fill their boxes
/// badly; of those on the screen only.
///
/// The plane through the eye and the screen's line u = c has the normal right − c·forward (right
/// alone in orthographic views, where it passes the eye at the distance c). In canonical space that
/// is linear in c, and a shape's support there takes one square root.
struct alignas(64) ScreenShape {
  double across[3][4];  // Mᵀ · right, twice, and Mᵀ · up, twice; M is canonical_to_world
  double offset[4];     // of the centre from the eye, along right, twice, and up, twice
  double forward[3];    // Mᵀ · forward
  double offset_forward;
  double radius_top, radius_bottom;  // a frustum's; a sphere's are −1
  double slack;
};
ScreenShape screen_shape(const CanonicalPrimitive& primitive, const FrameRays& frame);

/// Of up to 64 primitives (indices, the top bit ignored), those whose bit is set in `open`: the
/// bits of those that no ray through the tile (a box in screen space; its z does not count) meets,
/// by the planes through the eye and the tile's edges. Asks no more of a primitive that is small
/// against the tile, or centred in it: what its extent has left open will hardly be decided.
uint64_t find_misses(const ScreenShape* shapes, const Extent* screen, const uint32_t* primitives,
                     uint64_t open, const FrameRays& frame, const Box& tile);

}  // namespace csgcore
