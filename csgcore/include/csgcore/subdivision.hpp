// Spatial subdivision (paper §2): a kd-tree whose leaf cells hold the few primitives that matter
// there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/blist.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/kd_tree.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

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
};

/// Counts of leaves by kind, and of the tests of leaves in the tree.
struct LeafCensus {
  uint64_t by_kind[kLeafKinds] = {};
  uint64_t tests = 0;
  uint64_t leaves() const;  // without kReplaced, which are no part of the tree
};
LeafCensus census(const Subdivision& subdivision);

}  // namespace csgcore
