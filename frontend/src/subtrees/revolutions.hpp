// Plane figures, revolved about the y axis of their plane.
#pragma once

#include <cstdint>
#include <optional>

#include "csgcore/geometry.hpp"
#include "solids/figure_solids.hpp"
#include "solids/revolved_solid.hpp"
#include "subtrees/figure_tree.hpp"
#include "subtrees/lowered_subtree.hpp"

namespace frontend {

/// More sections cannot be told from a round solid.
constexpr int kMostSections = 3600;

/// Returns how OpenSCAD divides the turn of a figure that reaches so far from the axis.
TurnSections sections_of(const RotateExtrudeArguments& arguments, double radius);

/// Returns the bounds of a figure on one side of the axis x = 0, so that they end there if they
/// reach beyond it by less than a figure's rounding. Nothing if it stands on both sides, of which
/// `problems` is told.
std::optional<Rectangle> on_one_side(Rectangle bounds, const Node& node, NodeProblems& problems);

/// Returns the polygons without what is beyond the axis x = 0, which is no more than rounding.
SimplePolygons cut_at_axis(SimplePolygons polygons, bool is_left);

/// Lowers a subtree whose root is a rotate_extrude, in a frame.
LoweredSubtree lower_rotate_extrude(const PlaneSubtree& subtree, PlaneEvaluation& evaluation,
                                    const FigureTree& figures, uint32_t frame,
                                    const FrameTree& frames, FigureSolids& solids,
                                    NodeProblems& problems);

}  // namespace frontend
