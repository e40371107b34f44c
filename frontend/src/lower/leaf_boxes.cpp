#include "lower/leaf_boxes.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "solids/faceted_box.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::CsgTree;

/// How much is done at most to find a box: ten milliseconds for a leaf, and twenty for the whole of
/// a final render. Most boxes take ten microseconds.
constexpr uint64_t kTestsOfLeaf = 1 << 16;
constexpr uint64_t kTestsOfDesign = 1 << 17;
constexpr uint64_t kTestsOfOperand = 64;         // more, for each operand
constexpr uint64_t kTestsOfAllLeaves = 1 << 20;  // each has a share of what others leave

csgcore::BoundsBudget budget_of(const CsgTree& solid, uint64_t tests) {
  return {tests + kTestsOfOperand * solid.tokens().size()};
}

/// The box that OpenSCAD finds for a solid that it evaluates as a whole. `rest` is the box of what
/// is left of it, and `facets` that of its operands as OpenSCAD's facets, which what is round may
/// exceed here. In a frame that is turned, the corners of the solid's own box may exceed it as
/// well.
Box combined_box(const Box& rest, const csgcore::Affine& frame_to_world, const Box& facets) {
  if (rest.empty() || !is_axis_aligned(frame_to_world)) return rest;
  const Box both = csgcore::intersection(rest, facets);
  return both.empty() ? rest : both;
}

/// Finds the boxes of leaves.
class BoxFinder {
 public:
  BoxFinder(const Collector& collected, const Leaves& leaves)
      : collected_(collected), leaves_(leaves), is_of_plate_(collected.are_of_plates()) {}

  /// `seen` has the boxes of the primitives.
  LeafBoxes find(const Design& trees, std::vector<Box> seen, bool measures_leaves, bool decides) {
    LeafBoxes boxes{std::move(seen), {}};
    if (decides) {
      for (uint32_t i = 0; i < collected_.primitives.size(); ++i) {
        boxes.deciding.push_back(deciding_box(i, boxes.seen[i]));
      }
    }
    const auto first = static_cast<uint32_t>(boxes.seen.size());
    for (uint32_t leaf = first; leaf < leaves_.size(); ++leaf) {
      const std::optional<Box>& known = leaves_.box(leaf);
      boxes.seen.push_back(known ? *known
                                 : box_of_positive_leaves(leaves_.solid(leaf), boxes.seen));
    }
    std::vector<bool> matters(leaves_.size(), decides);
    if (measures_leaves && !decides && leaves_.has_compound()) {
      matters = looked_at(trees, boxes.seen);
    }
    for (uint32_t leaf = first; leaf < leaves_.size(); ++leaf) {
      const bool is_known = leaves_.box(leaf).has_value();
      const bool is_plate = is_of_plate_[leaves_.first_primitive(leaf)];
      const bool is_measured = !is_plate && matters[leaf] && (decides || !is_known);
      const Box rest = is_measured ? rest_of(leaf) : Box();
      Box& seen_box = boxes.seen[leaf];
      if (is_measured && !is_known) seen_box = combined_box(rest, frame_of(leaf), seen_box);
      if (decides) boxes.deciding.push_back(is_plate ? seen_box : rest);
    }
    return boxes;
  }

 private:
  /// Returns by leaf whether --viewall looks at its box: not at those of what is subtracted.
  std::vector<bool> looked_at(const Design& trees, std::span<const Box> boxes) const {
    std::vector<bool> result(leaves_.size());
    for (const auto& [kind, tree] : trees.parts) {
      for (const LeafUse& use : uses_of_leaves(tree, boxes)) {
        if (!use.is_subtracted) result[use.leaf] = true;
      }
    }
    return result;
  }

  const csgcore::Affine& frame_of(uint32_t leaf) const {
    return collected_.frames[leaves_.frame(leaf)].to_world;
  }

  Box rest_of(uint32_t leaf) {
    const CsgTree& solid = leaves_.solid(leaf);
    csgcore::BoundsBudget budget = budget_of(solid, kTestsOfLeaf);
    budget.tests = std::min(budget.tests, tests_left_ / (leaves_.size() - leaf));
    tests_left_ -= budget.tests;
    const Box box = tight_box(collected_.primitives, solid, frame_of(leaf), budget);
    tests_left_ += budget.tests;
    return box;
  }

  /// OpenSCAD's facets lie within what is round.
  Box deciding_box(uint32_t primitive, const Box& facets) const {
    const csgcore::Primitive& solid = collected_.primitives[primitive];
    const bool has_facets = solid.polyhedron() != nullptr || solid.mesh() != nullptr;
    if (has_facets || is_of_plate_[primitive]) return facets;
    Box box = facets;
    box.merge(csgcore::canonicalize(solid).bounds);
    return box;
  }

  const Collector& collected_;
  const Leaves& leaves_;
  std::vector<bool> is_of_plate_;  // by primitive
  uint64_t tests_left_ = kTestsOfAllLeaves;
};

}  // namespace

LeafBoxes boxes_of_leaves(Collector& collected, const Leaves& leaves, const Design& trees,
                          bool measures_leaves, bool decides) {
  return BoxFinder(collected, leaves)
      .find(trees, std::move(collected.boxes), measures_leaves, decides);
}

Box box_of_result(const Collector& collected, const CsgTree& solid, const Box& facets) {
  csgcore::BoundsBudget budget = budget_of(solid, kTestsOfDesign);
  return combined_box(tight_box(collected.primitives, solid, {}, budget), {}, facets);
}

using csgcore::Affine;
using csgcore::Box;
using csgcore::Primitive;

Box tight_box(std::span<const Primitive> primitives, const csgcore::CsgTree& solid,
              const Affine& frame_to_world, csgcore::BoundsBudget& budget) {
  std::vector<uint32_t> used;
  std::unordered_map<uint32_t, uint32_t> new_indices;
  const csgcore::CsgTree tree = csgcore::renamed(solid, [&](uint32_t index) {
    const auto [entry, is_new] = new_indices.try_emplace(index, static_cast<uint32_t>(used.size()));
    if (is_new) used.push_back(index);
    return entry->second;
  });
  const Affine to_frame = inverse_of(frame_to_world);
  std::vector<csgcore::CanonicalPrimitive> in_frame;
  in_frame.reserve(used.size());
  for (const uint32_t index : used) {
    Primitive primitive = primitives[index];
    primitive.local_to_world = csgcore::compose(to_frame, primitive.local_to_world);
    if (!csgcore::is_valid(primitive)) return tight_box(primitives, solid, {}, budget);
    in_frame.push_back(csgcore::canonicalize(primitive));
  }
  const Box box = csgcore::tight_bounds(in_frame, tree, budget);
  return box.empty() ? box : mapped(frame_to_world, box);
}

}  // namespace frontend
