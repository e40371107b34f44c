// Operands that change nothing: what is there twice, or lies within another one.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/csg_tree.hpp"
#include "csgcore/extent.hpp"

namespace csgcore {

/// A tree without some of its operands, which stands for the same solid and shows the same picture.
struct LeanTree {
  CsgTree tree;
  /// Primitives of which it depends that the tree is right: if none of them changes, it still is.
  /// Ascending.
  std::vector<uint32_t> grounds;
  /// Primitives that the whole tree names, and this one does not: those that lie within others, and
  /// those that equal others. Ascending.
  std::vector<uint32_t> inner, equal;
};

/// Leaves out, of each operation,
/// - operands that equal a later one: primitives of the same shape, numbers and matrix, and
///   operations of equal operands in the same order;
/// - of a union, and of what is subtracted from one solid, primitives that lie within one of the
///   largest: and later ones only if they touch its surface nowhere.
/// Of coincident faces the last in file order shows (NUMERICS.md), so that colours and ids need not
/// agree. None if there is nothing to leave out. `extents`: of the primitives, index for index;
/// `thickness_tolerance`: the tolerance, in world units. Takes time proportional to the tree.
std::optional<LeanTree> leave_out_redundant(const CsgTree& tree,
                                            std::span<const CanonicalPrimitive> primitives,
                                            std::span<const Extent> extents,
                                            double thickness_tolerance);

}  // namespace csgcore
