#include "csgcore/canonical_primitive.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "canonical_slack.hpp"
#include "shapes.hpp"

namespace csgcore {
namespace {

bool contains_canonical(const CanonicalPrimitive& primitive, const Vec3& point) {
  return primitive.shape == Shape::kSphere ? sphere::contains(point)
                                           : frustum::contains(primitive, point);
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

/// Relative error of canonical coordinates: the rounding of the map's application, of the centre,
/// and of its inversion (x' = W·C·x for the true x, so that W·C − 1 is the error).
double canonical_error(const CanonicalPrimitive& primitive) {
  constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();
  const Mat3 error = primitive.world_to_canonical * primitive.canonical_to_world - Mat3{1.0};
  double largest = 0;
  for (int row = 0; row < 3; ++row) {
    largest = std::max(largest,
                       std::abs(error[0][row]) + std::abs(error[1][row]) + std::abs(error[2][row]));
  }
  return kRounding + largest;
}

}  // namespace

CanonicalPrimitive canonicalize(const Primitive& primitive) {
  CanonicalPrimitive result = primitive.shape == Shape::kSphere ? sphere::canonicalize(primitive)
                                                                : frustum::canonicalize(primitive);
  result.canonical_error = canonical_error(result);
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
  return classify_within_bounds(primitive, cell);
}

Classification classify_within_bounds(const CanonicalPrimitive& primitive, const Box& cell) {
  return primitive.shape == Shape::kSphere ? sphere::classify(primitive, cell)
                                           : frustum::classify(primitive, cell);
}

CanonicalCell to_canonical(const CanonicalPrimitive& primitive, const Box& cell) {
  const Vec3 half = 0.5 * (cell.max - cell.min);
  const Vec3 offset = cell.center() - primitive.center;
  const Mat3& map = primitive.world_to_canonical;
  CanonicalCell canonical;
  canonical.center = map * offset;
  canonical.half = Mat3{map[0] * half.x, map[1] * half.y, map[2] * half.z};
  // The sum of the absolute values of all products that the coordinates are sums of.
  const Vec3 reach = glm::abs(offset) + half;
  const Vec3 magnitude =
      glm::abs(map[0]) * reach.x + glm::abs(map[1]) * reach.y + glm::abs(map[2]) * reach.z;
  canonical.slack = kCanonicalSlack +
                    primitive.canonical_error * std::max({magnitude.x, magnitude.y, magnitude.z});
  return canonical;
}

bool contains(const CanonicalPrimitive& primitive, const Vec3& point_world) {
  return contains_canonical(primitive,
                            primitive.world_to_canonical * (point_world - primitive.center));
}

}  // namespace csgcore
