// Making one again what the file's rounding has put apart (frontend/HEALING.md).
#pragma once

#include <cstdint>
#include <span>

#include "csgcore/primitive.hpp"
#include "heal/frames.hpp"

namespace frontend {

/// Cap planes, faces of polyhedra, axes, sphere centres and radii of different primitives that
/// agree within what the rounding of the matrices between them explains become one, by small
/// changes of local_to_world. A primitive whose matrices are exact is not moved, and none moves by
/// more than the two bounds of the pair that is made to agree (a polyhedron, aslant: twice that).
/// Features that stand in one frame, or differ by more than that, stay as they are. `frame_of`
/// gives each primitive's frame; `design` is a box around them all. O(n log n). Doing it again
/// changes nothing.
void merge_features(std::span<csgcore::Primitive> primitives, std::span<const uint32_t> frame_of,
                    const FrameTree& frames, const csgcore::Box& design);

}  // namespace frontend
