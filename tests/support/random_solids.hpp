// Random trees of closed polyhedra in which faces, edges and vertices coincide, to judge what the
// mesh kernel makes of them.
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "csgcore/boundary_mesh.hpp"
#include "csgcore/csg_tree.hpp"
#include "test_meshes.hpp"

namespace test_support {

csgcore::TriangleSet surface_of(const MeshParts& parts);

/// An operand of a tree: a closed surface, and the same solid as an operation on shells that do not
/// cross themselves and face outwards. So an oracle that knows no winding numbers can have it, too.
struct SolidOperand {
  enum class Rule : uint8_t {
    kUnion,
    kSeparatePair,  // the points that are in one of two shells, but not in both
    kUnknown,       // there are no such shells
  };
  MeshParts surface;
  std::vector<MeshParts> shells;  // a union of none is empty
  Rule rule = Rule::kUnion;
};

/// A tree over operands that stays open to changes, as a CsgTree does not.
struct RandomSolid {
  struct Step {
    enum class Kind : uint8_t { kOpen, kOperand, kClose } kind;
    csgcore::Op op = csgcore::Op::kUnion;  // of kOpen
    uint32_t operand = 0;                  // of kOperand
  };
  std::vector<SolidOperand> operands;
  std::vector<Step> steps;

  std::vector<csgcore::TriangleSet> surfaces() const;
  csgcore::CsgTree tree() const;
  bool has_shells() const;  // of each operand
  /// Returns the tree over the shells of all operands, which are appended in order.
  csgcore::CsgTree tree_of_shells(std::vector<MeshParts>& shells) const;
  /// Returns the solid without that operand, and without operations that are left with nothing.
  RandomSolid without_operand(uint32_t operand) const;
  /// Returns the solid in which the operands of an operation, the open-th from the left, stand in
  /// its place.
  RandomSolid without_operation(uint32_t open) const;
  uint32_t operation_count() const;
  /// Returns OpenSCAD's text of the solid, with all digits.
  std::string as_openscad() const;
};

/// Returns a random solid, mostly of a few operands, the same for the same seed. All coordinates
/// are multiples of 2^-30, and less than 2^9 from a common middle, so that the rounding to 2^-39 of
/// that separates no faces that coincide.
RandomSolid random_solid(uint32_t seed);

/// Returns a small solid that `fails` accepts as it accepts `solid`: nothing that can be left out
/// alone is left in it.
RandomSolid minimised(const RandomSolid& solid,
                      const std::function<bool(const RandomSolid&)>& fails);

/// Returns a prism between z = 0 and `height` over a closed loop, whose caps are fans from its
/// first point. The loop may cross itself; then the caps have triangles that cancel each other.
MeshParts fan_prism_parts(const std::vector<std::array<double, 2>>& loop, double height);
/// A prism over a U: a square of three units with a notch of one unit's width and height.
MeshParts u_prism_parts(double unit, double height);

}  // namespace test_support
