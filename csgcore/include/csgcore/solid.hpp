// A scene made ready for subdivision and ray tracing: primitives in canonical form, and a tree
// compiled to a Blist.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "csgcore/blist.hpp"
#include "csgcore/canonical_primitive.hpp"
#include "csgcore/csg_tree.hpp"
#include "csgcore/scene.hpp"

namespace csgcore {

struct CellList;
class OperandGroups;

/// The canonical primitives of a scene, with the same indices. The solids of its trees share them.
using CanonicalPrimitives = std::vector<CanonicalPrimitive>;
std::shared_ptr<const CanonicalPrimitives> canonical_primitives(const Scene& scene);

/// The solid of one tree of a scene; immutable.
class Solid {
 public:
  /// Every index in `tree` must be below primitives->size().
  Solid(std::shared_ptr<const CanonicalPrimitives> primitives, const CsgTree& tree);

  std::span<const CanonicalPrimitive> primitives() const { return *primitives_; }
  /// The extents of primitives(), with the same indices; none if the tree is empty.
  std::span<const Extent> extents() const;
  /// The whole tree as a list that is valid everywhere, without redundant operands, which change
  /// nothing (redundant_operands.hpp).
  const Blist& list() const { return list_; }
  /// list() in the form that is restricted to cells and tiles; null if the tree is empty.
  const CellList* cell_list() const { return cell_list_.get(); }
  /// list() with its operands in a BVH (operand_groups.hpp).
  const OperandGroups& groups() const { return *groups_; }
  /// A box around the solid, computed along the tree: for a union it is the union of the operands'
  /// boxes, for an intersection their intersection, for a difference the first operand's box. It is
  /// empty if the solid is known to be.
  const Box& bounds() const { return bounds_; }
  /// Returns whether the point lies in the solid. On a surface either answer may come.
  bool contains(const Vec3& point) const;

 private:
  std::shared_ptr<const CanonicalPrimitives> primitives_;
  Blist list_;
  std::shared_ptr<const CellList> cell_list_;
  std::shared_ptr<const OperandGroups> groups_;
  Box bounds_;
};

/// How much tight_bounds() may do, in tests of a primitive against a cell, which take some 0.1 µs
/// each. Without a test the box is that of the operands.
struct BoundsBudget {
  uint64_t tests;
};

/// Returns the tree without operands that change nothing of its solid but for what is thinner than
/// the thickness tolerance: those that equal another one of their operation, or lie within one.
CsgTree without_redundant_operands(const CanonicalPrimitives& primitives, const CsgTree& tree);

/// Returns a box that holds all of the tree's solid, but for what is thinner than the thickness
/// tolerance (NUMERICS.md) and so does not exist. It is empty if nothing else is left. A side is
/// exact, or as far outside as 2^-13 of the box's largest side; where surfaces meet at the side
/// along a curve it is farther outside, by as much as the budget falls short. What is spent is
/// taken from the budget.
Box tight_bounds(std::span<const CanonicalPrimitive> primitives, const CsgTree& tree,
                 BoundsBudget& budget);

}  // namespace csgcore
