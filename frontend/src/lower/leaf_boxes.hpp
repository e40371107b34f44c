// The boxes of a design's leaves, by which its camera stands and its products are found.
#pragma once

#include <span>
#include <vector>

#include "csgcore/csg_tree.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"
#include "csgcore/solid.hpp"
#include "lower/collector.hpp"
#include "lower/composition.hpp"
#include "solids/leaves.hpp"

namespace frontend {

/// The boxes of a design's leaves, in the world.
struct LeafBoxes {
  /// OpenSCAD's, which --viewall looks at.
  std::vector<csgcore::Box> seen;
  /// Those that decide about products, and therefore hold all of the leaves, or are plates' flat
  /// boxes. Empty unless they are needed.
  std::vector<csgcore::Box> deciding;
};

/// Returns the boxes of all leaves. Takes those of the primitives from the collector. Those of
/// compound leaves that the trees do not subtract are tight if `measures_leaves` is true; `decides`
/// asks for LeafBoxes::deciding.
LeafBoxes boxes_of_leaves(Collector& collected, const Leaves& leaves, const Design& trees,
                          bool measures_leaves, bool decides);

/// Returns the box of the outcome of a final render. `facets` is that of the operands.
csgcore::Box box_of_result(const Collector& collected, const csgcore::CsgTree& solid,
                           const csgcore::Box& facets);

/// Returns the box, in the world, of the corners of the solid's csgcore::tight_bounds() in its own
/// frame. If doubles do not hold the solid there, its frame is the world.
csgcore::Box tight_box(std::span<const csgcore::Primitive> primitives,
                       const csgcore::CsgTree& solid, const csgcore::Affine& frame_to_world,
                       csgcore::BoundsBudget& budget);

}  // namespace frontend
