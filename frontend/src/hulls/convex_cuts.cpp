#include "hulls/convex_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "hulls/point_hull.hpp"

namespace frontend {
namespace {

using csgcore::HalfSpace;
using csgcore::Vec3;

/// A point so near to a plane lies on it, as a share of the size.
constexpr double kOnPlane = 0x1p-44;

double size_of(const Corners& corners) {
  csgcore::Box box;
  for (const Vec3& corner : corners) box.merge(corner);
  return box.diagonal();
}

Corners without_inner_points(const Corners& points) {
  const PointHull hull = point_hull(on_grid(points));
  Corners result;
  if (hull.dimension < 3) return result;
  for (const uint32_t corner : hull.corners) result.push_back(points[corner]);
  return result;
}

}  // namespace

Corners cut(const Corners& corners, const HalfSpace& half_space) {
  const double slack = kOnPlane * size_of(corners) * glm::length(half_space.normal);
  std::vector<double> heights;
  bool has_inner = false;
  bool has_outer = false;
  for (const Vec3& corner : corners) {
    heights.push_back(glm::dot(half_space.normal, corner) - half_space.offset);
    has_inner = has_inner || heights.back() < -slack;
    has_outer = has_outer || heights.back() > slack;
  }
  if (!has_inner) return {};
  if (!has_outer) return corners;
  Corners result;
  for (size_t i = 0; i < corners.size(); ++i) {
    if (heights[i] <= slack) result.push_back(corners[i]);
  }
  for (const PointHull::Triangle& triangle : point_hull(on_grid(corners)).triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t inner = triangle[k], outer = triangle[(k + 1) % 3];
      // Each edge is passed once in either direction.
      if (!(heights[inner] < -slack && heights[outer] > slack)) continue;
      const double share = heights[inner] / (heights[inner] - heights[outer]);
      result.push_back(corners[inner] + share * (corners[outer] - corners[inner]));
    }
  }
  return without_inner_points(result);
}

Corners intersection(const Corners& corners, std::span<const HalfSpace> half_spaces) {
  Corners result = corners;
  for (const HalfSpace& half_space : half_spaces) {
    if (result.empty()) break;
    result = cut(result, half_space);
  }
  return result;
}

std::vector<Corners> difference(const Corners& corners, std::span<const HalfSpace> half_spaces) {
  if (intersection(corners, half_spaces).empty()) return {corners};
  std::vector<Corners> result;
  Corners rest = corners;
  for (const HalfSpace& half_space : half_spaces) {
    Corners outside = cut(rest, {-half_space.normal, -half_space.offset});
    if (!outside.empty()) result.push_back(std::move(outside));
    rest = cut(rest, half_space);
  }
  return result;
}

}  // namespace frontend
