// Plane figures, extruded along z.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "heal/frames.hpp"
#include "solids/figure_solids.hpp"
#include "subtrees/figure_tree.hpp"
#include "subtrees/lowered_subtree.hpp"

namespace frontend {

/// A node that extrudes or revolves figures.
struct Extrusion {
  const Node& node;
  const NodeData& data;
  const FigureTree& figures;  // those of its children
  /// Returns figures whose union these operations leave. It may take long: there is no need for it
  /// where the operations commute with extruding.
  std::function<std::span<const Figure>()> outcome;
  uint32_t frame;  // where the node stands
  const FrameTree& frames;
  FigureSolids& solids;
  NodeProblems& problems;
  /// The solid is an operand of a hull, a sum or the like, and is not drawn: sheets that stand for
  /// what has no volume are left out, and no operations are added.
  bool is_operand = false;

  const csgcore::Affine& to_world() const { return frames[frame].to_world; }
};

/// Extrudes each figure by itself. Of a plate the boxes are flat.
LoweredSubtree extrude(const FigureTree& figures, const Layers& layers, bool is_plate,
                       const csgcore::Affine& root_to_world, const FrameTree& frames,
                       FigureSolids& solids);

/// Returns the union of solids that the extrusion has become, in coordinates of `to_world`, as is
/// the box around them.
LoweredSubtree in_place_of(const Extrusion& extrusion, std::vector<csgcore::Primitive> solids,
                           const csgcore::Box& box, const csgcore::Affine& to_world);

}  // namespace frontend
