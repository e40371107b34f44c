// The box of a solid, as tight as that of what its operations leave.
#pragma once

#include <span>

#include "csgcore/csg_tree.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"
#include "csgcore/tight_bounds.hpp"

namespace frontend {

/// Returns the box, in the world, of the corners of the solid's csgcore::tight_bounds() in its own
/// frame. If doubles do not hold the solid there, its frame is the world.
csgcore::Box tight_box(std::span<const csgcore::Primitive> primitives,
                       const csgcore::CsgTree& solid, const csgcore::Affine& frame_to_world,
                       csgcore::BoundsBudget& budget);

}  // namespace frontend
