// The boundary of a solid whose parts are turned against each other.
#pragma once

#include <span>

#include "csgcore/csg_tree.hpp"
#include "csgcore/triangle_set.hpp"
#include "frontend/turned_frames.hpp"

namespace frontend {

/// Returns the boundary of what the tree makes of the operands, surfaces in the world's
/// coordinates, as csgcore::boundary_mesh() does. What a turned frame holds is evaluated in the
/// coordinates of that frame if faces of its parts are in one plane: a matrix that turns rounds
/// them apart, so that both would be left where the design has neither. Throws Stopped
/// (stop_scope.hpp).
csgcore::TriangleSet framed_boundary(std::span<const csgcore::TriangleSet> operands,
                                     const csgcore::CsgTree& tree, const TurnedFrames& frames);

}  // namespace frontend
