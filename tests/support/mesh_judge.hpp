// Judges a mesh by what it is made of, sharing nothing with csgcore: whether it is a closed
// surface, whether it crosses itself, and, along random lines, whether it bounds what a tree makes
// of its operands.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "csgcore/boundary_mesh.hpp"
#include "csgcore/csg_tree.hpp"

namespace test_support {

/// What is further apart than this share of half the size is so by more than rounding, except that
/// of vertices to double far from the origin, which is added.
constexpr double kRoundingShare = 1e-12;

/// Returns what is wrong with the surface as a closed 2-manifold, or "". Each edge has two
/// triangles, which run through it in opposite directions; the triangles of a vertex are one fan;
/// indices exist, coordinates are finite, and no triangle names a vertex twice.
std::string manifold_flaw(const csgcore::TriangleSet& surface);

/// Returns how many triangles have vertices of different places and still no area.
uint64_t flat_triangles(const csgcore::TriangleSet& surface);

/// Returns what crosses in the surface, or "". Two triangles cross if one has to move further than
/// rounding (kRoundingShare) until they touch at most. If both lie in one plane, it moves within.
std::string crossing_flaw(const csgcore::TriangleSet& surface);

long double volume_of(const csgcore::TriangleSet& surface);
long double area_of(const csgcore::TriangleSet& surface);
/// Returns the sum of the lengths of all edges. An error of the vertices times this, or times the
/// area, bounds that of the area, or of the volume.
long double edge_length_of(const csgcore::TriangleSet& surface);

/// What a comparison along lines has seen.
struct LineTotals {
  uint64_t lines = 0;
  uint64_t undecided = 0;  // lines that meet an edge up to rounding
  uint64_t points = 0;     // between crossings, at which both were compared
  uint64_t points_inside = 0;
  uint64_t faces = 0;       // crossings of the result at which the named operand was compared
  uint64_t coincident = 0;  // of these, where several operands have faces
  uint64_t not_last = 0;    // of these, where the operand shown is not the last that has a face
};

/// Compares a result with its operands along random lines that are parallel to an axis, many of
/// which pass near to corners. Between any two crossings that are apart, the winding number of the
/// result must be 1 where the tree has the value that the operands' winding numbers give it, and
/// else 0. Where the result is crossed, the operand that it names must be the one that NUMERICS.md
/// shows: the last of those that make the tree change there.
class LineJudge {
 public:
  /// What it is given has to outlive it. The operands' vertices may have been moved by
  /// `input_rounding`: lines then keep away from corners.
  LineJudge(std::span<const csgcore::TriangleSet> operands, const csgcore::CsgTree& tree,
            const csgcore::BoundaryMesh& result, double input_rounding = 0);

  /// Returns the first thing that is wrong, or "".
  std::string flaw(uint32_t lines, uint32_t seed, LineTotals& totals) const;

 private:
  struct Line;
  struct Crossing;
  std::string flaw_along(const Line& line, LineTotals& totals) const;
  Line random_line(std::mt19937& random) const;

  std::span<const csgcore::TriangleSet> operands_;
  const csgcore::CsgTree& tree_;
  const csgcore::BoundaryMesh& result_;
  csgcore::Box box_;
  double input_rounding_;
  double rounding_;  // the length below which differences are taken for rounding
};

}  // namespace test_support
