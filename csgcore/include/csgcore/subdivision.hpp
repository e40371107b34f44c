// Spatial subdivision (paper §2): a kd-tree whose leaf cells hold the few primitives that matter
// there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/blist.hpp"
#include "csgcore/kd_tree.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/tolerance.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

/// What Subdivision::update did.
struct SubdivisionUpdate {
  /// All was subdivided anew. Otherwise leaves and tests up to these indices are what they were,
  /// but for leaves that are kReplaced now, and for the indices of primitives; the rest is new.
  bool is_anew = false;
  size_t first_new_leaf = 0;
  size_t first_new_test = 0;
  uint64_t leaves_kept = 0;
  uint64_t leaves_replaced = 0;
  uint64_t leaves_made = 0;
};

/// The finished kd-tree. nodes[0] is the root; empty if the solid is.
class Subdivision {
 public:
  /// The solid must outlive the subdivision.
  Subdivision(const Solid& solid, SubdivisionOptions options, const BatchSink& sink = {});

  const Solid& solid() const { return *solid_; }
  const SubdivisionOptions& options() const { return options_; }
  std::span<const KdNode> nodes() const { return nodes_; }
  std::span<const Leaf> leaves() const { return leaves_; }
  std::span<const BlistTest> tests() const { return tests_; }
  std::span<const BlistTest> tests_of(const Leaf& leaf) const {
    return tests().subspan(leaf.first_test, leaf.test_count);
  }
  const Box& root_box() const { return root_box_; }
  size_t bytes() const;

  /// Paper §2.3: subdivides on where cells that were dropped for the old view exceed the threshold
  /// in the new one. Returns whether anything changed. Leaves keep their indices. The budget is
  /// that of all views together: what it does not suffice for is drawn, but not divided.
  bool refine(const View& view);

  /// Follows an edit: `solid` is of the scene after it, that of this subdivision of the same tree
  /// before; both must live. `tree_edit` is that tree's (SceneEdit::model).
  /// Leaves are kept whose cells lie wholly inside or wholly outside of every changed primitive's
  /// old and new form alike; others are subdivided anew, each for itself. Where that is too little
  /// to be worth it all is subdivided anew: where the root box changes, the cells that change hold
  /// more than a third of the tests, more than half of what is stored has been replaced by and
  /// by, the budget does not suffice for what is added, or cells are dropped below a threshold.
  SubdivisionUpdate update(const Solid& solid, const SceneEdit& edit, TreeEdit tree_edit);

  /// The leaf that holds the point (of several that share it, one); nullptr outside the root box.
  const Leaf* find(const Vec3& point) const;

  /// How far, in world units, each cell's function is valid beyond the cell itself: an overlap that
  /// absorbs the float rounding of a renderer's cell boundaries.
  double overlap() const { return overlap_; }

 private:
  const Solid* solid_;
  SubdivisionOptions options_;
  Box root_box_;
  double overlap_ = 0;
  std::vector<KdNode> nodes_;
  std::vector<Leaf> leaves_;
  std::vector<BlistTest> tests_;
  uint64_t replaced_tests_ = 0;  // of leaves that update() has replaced
};

/// Leaf counts by kind.
struct LeafCensus {
  uint64_t by_kind[kLeafKinds] = {};
  uint64_t tests = 0;
  uint64_t leaves() const;  // all that the tree still has: kReplaced is not counted
};
LeafCensus census(const Subdivision& subdivision);

}  // namespace csgcore
