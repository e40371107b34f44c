// The skeleton oracle: CGAL's straight skeleton of a polygon with holes, whose events are ordered
// by exact arithmetic.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace oracle {

using SkeletonPolygon = std::vector<glm::dvec2>;

/// What one edge of the outline sweeps.
struct SkeletonFace {
  glm::dvec2 start, end;  // of the edge
  SkeletonPolygon corners;
};

/// Returns whether the polygon passes no point twice.
bool is_simple(const SkeletonPolygon& polygon);

/// Returns the faces of the skeleton; none if CGAL finds none. The first polygon is the one around,
/// and runs counterclockwise; the others are holes, run clockwise, and touch nothing. All are
/// simple.
std::vector<SkeletonFace> straight_skeleton(const std::vector<SkeletonPolygon>& polygons);

}  // namespace oracle
