// The convex hull of points of space.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hulls/grid_points.hpp"

namespace frontend {

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
  /// Three points, far from a line, of a hull that is a solid on the grid and only counts as a
  /// plane polygon; its plane is theirs.
  std::optional<Triangle> base;
};

/// Takes O(n log n) but for rare sets. Does not depend on the order of calls or on threads. Points
/// no further than `flat_thickness` of the hull's size from a plane, or a line, count as lying in
/// it: what bounds a solid is then ill-conditioned.
PointHull point_hull(const PointGrid& grid, double flat_thickness = 0);

}  // namespace frontend
