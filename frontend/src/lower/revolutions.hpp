// Plane figures, revolved about the y axis of their plane.
#pragma once

#include <cstdint>

#include "csgcore/geometry.hpp"
#include "lower/figure_solids.hpp"
#include "lower/figure_tree.hpp"
#include "lower/lowered_subtree.hpp"
#include "lower/node_problems.hpp"

namespace frontend {

/// Lowers a subtree whose root is a rotate_extrude, in a frame.
LoweredSubtree lower_rotate_extrude(const PlaneSubtree& subtree, PlaneEvaluation& evaluation,
                                    const FigureTree& figures, uint32_t frame,
                                    const csgcore::Affine& root_to_world, FigureSolids& solids,
                                    NodeProblems& problems);

}  // namespace frontend
