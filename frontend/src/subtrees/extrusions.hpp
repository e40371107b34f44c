// Plane figures, extruded along z.
#pragma once

#include <cstdint>

#include "heal/frames.hpp"
#include "solids/figure_solids.hpp"
#include "subtrees/figure_tree.hpp"
#include "subtrees/lowered_subtree.hpp"

namespace frontend {

/// Extrudes each figure by itself. Of a plate the boxes are flat.
LoweredSubtree extrude(const FigureTree& figures, const Layers& layers, bool is_plate,
                       const csgcore::Affine& root_to_world, const FrameTree& frames,
                       FigureSolids& solids);

/// Lowers a subtree whose root is a linear_extrude, in a frame.
LoweredSubtree lower_linear_extrude(const PlaneSubtree& subtree, PlaneEvaluation& evaluation,
                                    const FigureTree& figures, uint32_t frame,
                                    const FrameTree& frames, FigureSolids& solids,
                                    NodeProblems& problems);

}  // namespace frontend
