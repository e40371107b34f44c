// Plane figures, extruded along z.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "heal/frames.hpp"
#include "solids/figure_solids.hpp"
#include "subtrees/figure_tree.hpp"
#include "subtrees/lowered_subtree.hpp"

namespace frontend {

/// A node that extrudes or revolves figures.
struct Extrusion {
  SubtreeEvaluation& evaluation;
  uint32_t node;
  const FigureTree& figures;  // those of its children
  uint32_t frame;             // where the node stands
  const FrameTree& frames;
  /// The solid is an operand of a hull, a sum or the like, and is not drawn: sheets that stand for
  /// what has no volume are left out, and no operations are added.
  bool is_operand = false;

  const Node& syntax() const { return evaluation.subtree().syntax(node); }
  FigureSolids& solids() const { return evaluation.sources().figures; }
  const csgcore::Affine& to_world() const { return frames[frame].to_world; }
  uint32_t id() const { return figures.parts.front().id; }
  void tell(NodeProblems::Description problem) const {
    evaluation.problems().add(syntax(), std::move(problem));
  }
  /// Returns figures whose union the operations of `figures` leave. It may take long: there is no
  /// need for it where the operations commute with extruding.
  std::vector<Figure> outcome() const;
};

/// Extrudes each figure by itself. Of a plate the boxes are flat.
LoweredSubtree extrude(const FigureTree& figures, const Layers& layers, bool is_plate,
                       const csgcore::Affine& root_to_world, const FrameTree& frames,
                       FigureSolids& solids);

/// Returns a part of an extrusion, in the world.
SolidPart drawn_part(csgcore::Primitive&& primitive, uint32_t frame, uint32_t id,
                     const csgcore::Box& box);

/// Returns the union of solids that the extrusion has become, in coordinates of `to_world`, as is
/// the box around them. `is_smooth`: they stand for something round.
LoweredSubtree in_place_of(const Extrusion& extrusion, std::vector<csgcore::Primitive> solids,
                           const csgcore::Box& box, const csgcore::Affine& to_world,
                           bool is_smooth);

/// Returns the solid that `extruded` of the node's row makes.
SolidValue solid_of_extrusion(SubtreeEvaluation& evaluation, uint32_t node);

}  // namespace frontend
