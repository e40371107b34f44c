// Redundant operands, which change nothing: those that equal another one, or lie within one.
#pragma once

#include <optional>
#include <span>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/csg_tree.hpp"

namespace csgcore {

/// Returns the tree without the redundant operands of each operation, which has the same solid and
/// the same picture:
/// - operands that equal a later one: primitives of the same shape, numbers and matrix, and
///   operations of equal operands in the same order;
/// - in a union, and among the operands that a difference subtracts, primitives that lie within one
///   of the largest. A primitive that comes later in the file than the larger one must not touch
///   its surface.
/// The last of coincident faces is shown (NUMERICS.md), so that colours and ids need not agree.
/// Returns nothing if no operand is redundant. `extents` has the extents of `primitives`, with the
/// same indices; `thickness_tolerance` is in world units. Takes time proportional to the tree.
std::optional<CsgTree> leave_out_redundant(const CsgTree& tree,
                                           std::span<const CanonicalPrimitive> primitives,
                                           std::span<const Extent> extents,
                                           double thickness_tolerance);

}  // namespace csgcore
