// Solids within a subtree that OpenSCAD evaluates as a whole: primitives and convex bodies, and the
// operations on them.
#pragma once

#include <optional>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"
#include "hulls/generator.hpp"
#include "solids/operations.hpp"

namespace frontend {

/// A part of a solid: a primitive, or the hull of generators.
struct SolidPart {
  std::optional<csgcore::Primitive> primitive{};
  csgcore::FacetSettings facets{};  // of a primitive: OpenSCAD's
  bool is_faceted = false;          // of a primitive: its facets stand for something round
  uint32_t frame = 0;               // FrameTree; of what is drawn
  SupportSet body{};                // if there is no primitive
  /// The box of the corners that OpenSCAD has of it, in the coordinates around it: the world's, of
  /// what is drawn.
  csgcore::Box box{};
  /// What color() within the node that is evaluated gives it. Hulls and sums have none.
  std::optional<csgcore::Color> color{};

  /// Returns whether it is known to be convex.
  bool is_convex() const;
  /// Adds generators of its hull.
  void add_support(SupportSet& support) const;
  void map(const csgcore::Affine& map);
};

/// Returns the part that is a primitive, in the coordinates of its matrix.
SolidPart part_of(csgcore::Primitive primitive, const csgcore::FacetSettings& facets);
/// Returns the part that is a mesh. `is_smooth`: it stands for something round.
SolidPart faceted_part(csgcore::Primitive mesh, bool is_smooth);
/// Returns the part that is the hull of the generators. Without a box it is theirs.
SolidPart part_of(SupportSet body, const csgcore::Box& box = {});

using SolidValue = Operations<SolidPart>;

/// Returns values whose union the value is, of which none is a union of several parts.
std::vector<SolidValue> operands_of_union(const SolidValue& value);

}  // namespace frontend
