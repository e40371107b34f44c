// Makes features coincide again that the file's rounding has separated (frontend/HEALING.md).
#pragma once

#include <cstdint>
#include <span>

#include "csgcore/primitive.hpp"
#include "heal/frames.hpp"

namespace frontend {

/// Makes features of different primitives coincide, by small changes of local_to_world: cap planes,
/// faces of polyhedra, axes, sphere centres and radii that agree within what the rounding of the
/// matrices between them explains. A primitive whose matrices are exact is not moved, and none
/// moves by more than the two bounds of the pair that is made to agree (a polyhedron, aslant: twice
/// that). Features that are in one frame, or differ by more than that, stay as they are. `frame_of`
/// is the frame of each primitive; `design` is a box around them all. Takes O(n log n). A second
/// call changes nothing.
void merge_features(std::span<csgcore::Primitive> primitives, std::span<const uint32_t> frame_of,
                    const FrameTree& frames, const csgcore::Box& design);

}  // namespace frontend
