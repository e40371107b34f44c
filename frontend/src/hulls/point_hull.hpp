// The convex hull of points of space, on a grid.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/geometry.hpp"

namespace frontend {

/// A point of space on a grid of whole numbers, where predicates are exact. Coordinates from 0 to
/// 2^52, so that differences are exact in double, too.
struct GridPoint {
  int64_t x, y, z;
  auto operator<=>(const GridPoint&) const = default;
};

/// Points within a box, as multiples of 2^exponent from its least corner. A multiple is at most
/// 2^-51 of the box's longest side: the rounding of a point is far below what a picture or its
/// oracles tell apart.
struct PointGrid {
  csgcore::Vec3 origin{0.0};
  int exponent = 0;
  std::vector<GridPoint> points;  // in the given order
};

/// All coordinates must be finite.
PointGrid on_grid(std::span<const csgcore::Vec3> points);

/// Returns the normal (b − a) × (c − a), of which each component is rounded once.
csgcore::Vec3 normal_of(const GridPoint& a, const GridPoint& b, const GridPoint& c);

/// Returns 1 if d lies on the side of the plane a b c from which these are seen counterclockwise,
/// −1 on the other side, and 0 in the plane. It is exact.
int orientation(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d);

/// Returns whether the three points lie on a line. It is exact.
bool are_collinear(const GridPoint& a, const GridPoint& b, const GridPoint& c);

/// The hull's boundary, over the indices of the points. It is the exact hull of the points on their
/// grid, however they lie, but for what counts as flat.
struct PointHull {
  using Triangle = std::array<uint32_t, 3>;
  /// The dimension of the smallest flat that holds all points (but for flat_thickness): −1 for no
  /// points, 3 for a solid.
  int dimension = -1;
  /// A solid's triangles, counterclockwise as seen from outside. Neighbours may lie in one plane.
  std::vector<Triangle> triangles;
  /// A solid's triangles, by triangle: those across the edges from corner 0 to 1, 1 to 2 and 2 to
  /// 0.
  std::vector<Triangle> neighbors;
  /// The points that the boundary has as corners: of a solid in the given order, of a plane polygon
  /// around it, of a line its two ends.
  std::vector<uint32_t> corners;
};

/// Takes O(n log n) but for rare sets. Does not depend on the order of calls or on threads. Points
/// no further than `flat_thickness` of the hull's size from a plane, or a line, count as lying in
/// it: what bounds a solid is then ill-conditioned.
PointHull point_hull(const PointGrid& grid, double flat_thickness = 0);

}  // namespace frontend
