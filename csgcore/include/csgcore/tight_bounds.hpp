// The box of what the operations leave of a solid.
#pragma once

#include <cstdint>
#include <span>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/csg_tree.hpp"

namespace csgcore {

/// How much tight_bounds() may do, in tests of a primitive against a cell, which take some 0.1 µs
/// each. Without a test the box is that of the operands.
struct BoundsBudget {
  uint64_t tests;
};

/// Returns a box that holds all of the tree's solid, but for what is thinner than the thickness
/// tolerance (NUMERICS.md) and so does not exist. It is empty if nothing else is left. A side is
/// exact, or as far outside as 2^-13 of the box's largest side; where surfaces meet at the side
/// along a curve it is farther outside, by as much as the budget falls short. What is spent is
/// taken from the budget.
Box tight_bounds(std::span<const CanonicalPrimitive> primitives, const CsgTree& tree,
                 BoundsBudget& budget);

}  // namespace csgcore
