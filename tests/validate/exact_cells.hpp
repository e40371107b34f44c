// Computes the solid of a tree over convex polyhedra by cutting boxes in rationals: an oracle for
// the Nef oracle, with which it shares neither CGAL nor the polyhedra's vertices.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "oracle/nef_solid.hpp"

namespace test_support {

using oracle::Rational;
using RationalPoint = std::array<Rational, 3>;

/// normal·x ≤ offset inside.
struct RationalHalfSpace {
  RationalPoint normal;
  Rational offset;
};

class ExactCells {
 public:
  /// The polyhedra lie within ±kReach, and there are at most kMostPolyhedra of them.
  ExactCells(const csgcore::CsgTree& tree, std::span<const oracle::FacetedSolid> polyhedra);
  static constexpr double kReach = 1000;
  static constexpr std::size_t kMostPolyhedra = 10;

  /// The volume of the regularised solid, by inclusion and exclusion over all intersections of
  /// polyhedra.
  Rational volume() const;
  /// Returns nothing if the point is on a polyhedron's boundary.
  std::optional<bool> contains(const csgcore::Vec3& point) const;

 private:
  bool value(uint32_t inside) const;  // of the tree; bit i tells whether polyhedron i contains the
                                      // point

  const csgcore::CsgTree& tree_;
  std::vector<std::vector<RationalHalfSpace>> polyhedra_;
};

}  // namespace test_support
