#include "csgcore/canonical_primitive.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "canonical_slack.hpp"
#include "shapes.hpp"

namespace csgcore {
namespace {

bool contains_canonical(const CanonicalPrimitive& primitive, const Vec3& point) {
  return primitive.shape == Shape::kSphere ? sphere::contains(point)
                                           : frustum::contains(primitive, point);
}

bool separated(const CanonicalPrimitive& primitive, const CanonicalCell& cell) {
  return primitive.shape == Shape::kSphere ? sphere::separated(cell)
                                           : frustum::separated(primitive, cell);
}

/// A ball against a box, by the exact distances of the box's nearest and furthest points.
Classification classify_ball(const Vec3& center, double radius, const Box& cell) {
  double nearest2 = 0;
  double furthest2 = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = cell.min[axis] - center[axis];
    const double above = center[axis] - cell.max[axis];
    const double gap = std::max(std::max(below, above), 0.0);
    nearest2 += gap * gap;
    const double reach = std::max(-below, -above);  // both ≤ the cell's far side
    furthest2 += reach * reach;
  }
  const double radius2 = radius * radius;
  if (nearest2 > radius2 * (1.0 + kCanonicalSlack)) return Classification::kOutside;
  if (furthest2 < radius2 * (1.0 - kCanonicalSlack)) return Classification::kInside;
  return Classification::kCrosses;
}

/// By convexity, a cell whose 8 corners are inside is inside. The corners are pushed out from the
/// primitive's centre by the slack, so that rounding cannot make the claim.
Classification classify_corners(const CanonicalPrimitive& primitive, const CanonicalCell& cell) {
  int inside = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 point = cell.center + ((corner & 1) ? 1.0 : -1.0) * cell.half[0] +
                       ((corner & 2) ? 1.0 : -1.0) * cell.half[1] +
                       ((corner & 4) ? 1.0 : -1.0) * cell.half[2];
    if (contains_canonical(primitive, point * (1.0 + kCanonicalSlack))) ++inside;
    if (inside != 0 && inside != corner + 1) return Classification::kCrosses;
  }
  return inside == 8 ? Classification::kInside : Classification::kOutside;
}

}  // namespace

CanonicalPrimitive canonicalize(const Primitive& primitive) {
  CanonicalPrimitive result = primitive.shape == Shape::kSphere ? sphere::canonicalize(primitive)
                                                                : frustum::canonicalize(primitive);
  result.color = primitive.color;
  result.id = primitive.id;
  return result;
}

Classification classify(const CanonicalPrimitive& primitive, const Box& cell) {
  const Box& bounds = primitive.bounds;
  if (cell.min.x > bounds.max.x || cell.max.x < bounds.min.x || cell.min.y > bounds.max.y ||
      cell.max.y < bounds.min.y || cell.min.z > bounds.max.z || cell.max.z < bounds.min.z) {
    return Classification::kOutside;
  }
  if (primitive.ball_radius > 0) {
    return classify_ball(primitive.center, primitive.ball_radius, cell);
  }
  const Vec3 half = 0.5 * (cell.max - cell.min);
  const Mat3& map = primitive.world_to_canonical;
  const CanonicalCell canonical{map * (cell.center() - primitive.center),
                                Mat3{map[0] * half.x, map[1] * half.y, map[2] * half.z}};
  const Classification corners = classify_corners(primitive, canonical);
  if (corners != Classification::kOutside) return corners;
  return separated(primitive, canonical) ? Classification::kOutside : Classification::kCrosses;
}

bool contains(const CanonicalPrimitive& primitive, const Vec3& point_world) {
  return contains_canonical(primitive,
                            primitive.world_to_canonical * (point_world - primitive.center));
}

}  // namespace csgcore
