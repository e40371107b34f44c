// The cylinder, the frustum and the cone with either end pointed, under affine maps. Canonical:
// |z| ≤ 1 with a radius linear in z, the larger end's being 1.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "canonical_slack.hpp"
#include "shapes.hpp"

namespace csgcore::frustum {
namespace {

/// The point of the frustum furthest along `direction`.
Vec3 support(const CanonicalPrimitive& primitive, const Vec3& direction) {
  const double top = primitive.radius_mid + primitive.radius_slope;
  const double bottom = primitive.radius_mid - primitive.radius_slope;
  const double lateral = std::hypot(direction.x, direction.y);
  const bool at_top = direction.z + lateral * top >= -direction.z + lateral * bottom;
  const double radius = at_top ? top : bottom;
  const double scale = lateral > 0 ? radius / lateral : 0.0;
  return {direction.x * scale, direction.y * scale, at_top ? 1.0 : -1.0};
}

/// The point of the cell least far along `direction`.
Vec3 lowest(const CanonicalCell& cell, const Vec3& direction) {
  Vec3 point = cell.center;
  for (int i = 0; i < 3; ++i) {
    point -= (glm::dot(direction, cell.half[i]) > 0 ? 1.0 : -1.0) * cell.half[i];
  }
  return point;
}

}  // namespace

CanonicalPrimitive canonicalize(const Primitive& primitive) {
  CanonicalPrimitive result;
  result.shape = Shape::kFrustum;
  const double radius = std::max(primitive.r_bottom, primitive.r_top);
  const double half_height = 0.5 * (primitive.z_max - primitive.z_min);
  const double middle = 0.5 * primitive.z_min + 0.5 * primitive.z_max;
  result.radius_mid = 0.5 * (primitive.r_bottom / radius + primitive.r_top / radius);
  result.radius_slope = 0.5 * (primitive.r_top / radius - primitive.r_bottom / radius);
  const Mat3& linear = primitive.local_to_world.linear;
  result.center = primitive.local_to_world.point({0, 0, middle});
  result.canonical_to_world =
      Mat3{linear[0] * radius, linear[1] * radius, linear[2] * half_height};
  result.world_to_canonical = inverse(result.canonical_to_world);
  // The two end discs bound it; a disc's support along a world axis is its radius times the norm of
  // that axis' row over the disc's two directions.
  const Mat3& map = result.canonical_to_world;
  for (const double end : {-1.0, 1.0}) {
    const double end_radius = result.radius_mid + end * result.radius_slope;
    const Vec3 disc_center = result.center + end * map[2];
    Vec3 extent;
    for (int axis = 0; axis < 3; ++axis) {
      extent[axis] = end_radius * std::hypot(map[0][axis], map[1][axis]);
    }
    result.bounds.merge(Box{disc_center - extent, disc_center + extent});
  }
  return result;
}

bool contains(const CanonicalPrimitive& primitive, const Vec3& p) {
  const double radius = primitive.radius_mid + primitive.radius_slope * p.z;
  return std::abs(p.z) <= 1.0 && radius >= 0 && p.x * p.x + p.y * p.y <= radius * radius;
}

bool separated(const CanonicalPrimitive& primitive, const CanonicalCell& cell) {
  const double z_reach =
      std::abs(cell.half[0].z) + std::abs(cell.half[1].z) + std::abs(cell.half[2].z);
  if (std::abs(cell.center.z) - z_reach > 1.0 + kCanonicalSlack) return true;

  // A separating direction, starting from the wall's normal on the cell's side. Each step reflects
  // it at the plane between the two supporting points (Chung and Wang, "Quick collision detection of
  // polytopes in virtual environments", 1996); a step ends with a proof or without an answer.
  constexpr int kSteps = 5;
  Vec3 direction{cell.center.x, cell.center.y, 0};
  const double lateral = glm::length(direction);
  if (lateral == 0) return false;
  direction.z = -primitive.radius_slope * lateral;
  direction = glm::normalize(direction);
  for (int step = 0; step < kSteps; ++step) {
    const Vec3 gap = lowest(cell, direction) - support(primitive, direction);
    const double along = glm::dot(gap, direction);
    if (along > kCanonicalSlack) return true;
    const double gap2 = glm::dot(gap, gap);
    if (gap2 == 0) return false;
    direction -= (2.0 * along / gap2) * gap;
  }
  return false;
}

}  // namespace csgcore::frustum
