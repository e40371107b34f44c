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

/// Says what Subdivision::update did.
struct SubdivisionUpdate {
  /// Everything was subdivided anew. Otherwise the leaves and tests with indices below the next two
  /// members are those of before, except that replaced leaves have become kReplaced and that tests
  /// name primitives by their new indices. All others are new.
  bool is_anew = false;
  size_t first_new_leaf = 0;
  size_t first_new_test = 0;
  uint64_t leaves_kept = 0;
  uint64_t leaves_replaced = 0;
  uint64_t leaves_made = 0;
};

/// The finished kd-tree. nodes()[0] is the root; there are no nodes if the solid is empty.
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

  /// Paper §2.3: divides those cells that were dropped for the old view and exceed the threshold in
  /// the new one. Returns whether anything changed. Leaves keep their indices. All views together
  /// share one budget: cells for which it does not suffice become kGivenUp, which are drawn but not
  /// divided.
  bool refine(const View& view);

  /// Follows an edit. `solid` is the solid after the edit of the tree that this is the subdivision
  /// of; it and the solid before the edit must both be alive. `tree_edit` belongs to the tree
  /// (SceneEdit::model).
  ///
  /// A leaf is kept if its cell lies wholly inside or wholly outside of every changed primitive,
  /// and on the same side before and after the edit. Each other leaf is subdivided anew. Everything
  /// is subdivided anew if
  /// - the root box changes, the solid may have changed anywhere (TreeEdit::kAnywhere), or the
  ///   solid is empty before or after the edit,
  /// - more than some 2% of the primitives were changed (one always may),
  /// - the leaves to be replaced hold more than a third of the tests, or more than half of all
  ///   tests would belong to leaves replaced by this and earlier edits,
  /// - the budget does not suffice for the new cells, or threshold_px > 0.
  SubdivisionUpdate update(const Solid& solid, const SceneEdit& edit, TreeEdit tree_edit);

  /// Returns the leaf whose cell holds the point, one of them if it lies on their common face;
  /// nullptr outside the root box.
  const Leaf* find(const Vec3& point) const;

  /// How far beyond the cell itself, in world units, each cell's function is valid. This overlap
  /// absorbs the rounding of cell boundaries in a renderer that computes in float.
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

/// Counts of leaves by kind, and of the tests of leaves in the tree.
struct LeafCensus {
  uint64_t by_kind[kLeafKinds] = {};
  uint64_t tests = 0;
  uint64_t leaves() const;  // without kReplaced, which are no part of the tree
};
LeafCensus census(const Subdivision& subdivision);

}  // namespace csgcore
