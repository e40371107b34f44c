// Where shapes that fill their boxes badly lie on the screen.
#pragma once

#include "screen_extents.hpp"

namespace csgcore {

/// A primitive's support along the normals of planes through the eye and a line of the screen: what
/// tells, for a tile, that no ray through it meets the primitive. For shapes that fill their boxes
/// badly; of those on the screen only.
///
/// The plane through the eye and the screen's line u = c has the normal right − c·forward (right
/// alone in orthographic views, where it passes the eye at the distance c). In canonical space that
/// is linear in c, and a shape's support there takes one square root. A polyhedron's is that of the
/// quadric that encloses it.
struct alignas(64) ScreenShape {
  double across[3][4];  // Mᵀ · right, twice, and Mᵀ · up, twice; M is canonical_to_world
  double offset[4];     // of the centre from the eye, along right, twice, and up, twice
  double forward[3];    // Mᵀ · forward
  double offset_forward;
  double radius_top, radius_bottom;  // a frustum's; a sphere's are −1
  double slack;
};
ScreenShape screen_shape(const CanonicalPrimitive& primitive, const FrameRays& frame);

/// Narrows an extent found from the primitive's box to the shape itself, or to what encloses a
/// polyhedron of many vertices.
void narrow_extent(const CanonicalPrimitive& primitive, const ScreenShape& shape,
                   const FrameRays& frame, const ScreenOptions& options, Extent& screen);

/// Of up to 64 primitives (indices, the top bit ignored), those whose bit is set in `open`: the
/// bits of those that no ray through the tile (a box in screen space; its z does not count) meets,
/// by the planes through the eye and the tile's edges. Asks no more of a primitive that is small
/// against the tile, or centred in it: what its extent has left open will hardly be decided.
uint64_t find_misses(const ScreenShape* shapes, const Extent* screen, const uint32_t* primitives,
                     uint64_t open, const FrameRays& frame, const Box& tile);

}  // namespace csgcore
