// The budget of a subdivision, and how cells share it.
//
// No rule of the paper bounds the number of cells where surfaces meet along curves or coincide over
// faces. However small a cell at a shared rim is, all the primitives that share the rim cross it.
// If they are more than K, the cells along the rim are divided down to the pixel threshold, and the
// tree has as many cells for each rim as the rim is pixels long: gigabytes for a vase of 200
// frusta. So a subdivision has a budget (SubdivisionOptions::budget_bytes), which is spent in
// rounds:
//
// - The root cell gets a credit. Each division takes its cost from its cell's credit, and divides
//   the rest among the two halves in proportion to their tests. A cell whose credit does not
//   suffice is paused. The first round may use up only a part of the budget; as long as that lasts,
//   a cell may take many times its share, so that the cells of ordinary designs are hardly ever
//   paused.
// - When all other cells are done, the rest of the budget is dealt out to the paused cells in
//   proportion to their tests (there is a rest, since most subtrees need less than their share).
//   Each paused cell gets enough for one division at least, and they go on.
// - If the rest does not suffice to divide every paused cell once, all of them are given up: they
//   become leaves with more than K primitives (LeafKind::kGivenUp).
//
// So all parts of a design are cut short equally, no cell depends on when another one was divided,
// and the tree is the same for every number of threads. A design that stays within the budget gets
// the same cells as without a budget.
#pragma once

#include <algorithm>
#include <cstdint>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/kd_tree.hpp"
#include "csgcore/polyhedron.hpp"

namespace csgcore {

/// More than any memory, and small enough that its product with a number of tests does not
/// overflow.
constexpr uint64_t kLargestBudget = uint64_t{1} << 40;

/// Returns the cost of testing one primitive against a cell. Time counts in bytes, too: the test
/// takes about as long as making so many bytes of leaves.
inline uint64_t test_cost(const CanonicalPrimitive& primitive) {
  constexpr uint64_t kDescentCost = 64;  // into a BVH
  if (primitive.shared_shape) return kDescentCost;
  if (!primitive.polyhedron) return 1;
  constexpr uint64_t kFewFaces = 8, kFacesPerByte = 4;
  const uint64_t faces = primitive.polyhedron->entries().size();
  return 4 + (std::max(faces, kFewFaces) - kFewFaces) / kFacesPerByte;
}

/// Costs in bytes. `test_cost` is the mean over the solid's primitives.
class CellCosts {
 public:
  explicit CellCosts(uint64_t test_cost) : test_cost_(test_cost) {}

  /// Returns the highest cost of dividing a list of `count` tests: that for two halves which keep
  /// all of them.
  uint64_t most_division(uint32_t count) const {
    return kDivision + count * (sizeof(BlistTest) + test_cost_);
  }
  /// Returns the actual cost of a division. It is negative if the tests that were dropped took more
  /// bytes than the new cells.
  int64_t division(uint32_t count, uint32_t below, uint32_t above) const {
    return static_cast<int64_t>(kDivision + count * test_cost_) +
           static_cast<int64_t>(sizeof(BlistTest)) * (int64_t{below} + above - count);
  }
  /// Returns the cost of testing a list of `count` tests against some boxes.
  uint64_t probes(uint32_t count, uint32_t boxes) const {
    return boxes * (kProbe + count * test_cost_);
  }

 private:
  /// A division replaces a leaf by a node and two leaves.
  static constexpr uint64_t kDivision = 2 * sizeof(KdNode) + sizeof(Leaf);
  static constexpr uint64_t kProbe = 8;

  uint64_t test_cost_;
};

/// The bytes of a tree that is one leaf with `count` tests.
constexpr uint64_t leaf_bytes(uint32_t count) {
  return sizeof(KdNode) + sizeof(Leaf) + count * sizeof(BlistTest);
}

}  // namespace csgcore
