// The cylinder, the frustum, and the cone with either end pointed, under affine maps. In canonical
// space |z| ≤ 1, and the radius is linear in z and 1 at the larger end.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "csgcore/polyhedron.hpp"
#include "primitives/primitive_kind.hpp"

namespace csgcore {
namespace {

bool within(const Box& inner, const Box& outer) {
  return inner.min.x >= outer.min.x && inner.max.x <= outer.max.x && inner.min.y >= outer.min.y &&
         inner.max.y <= outer.max.y && inner.min.z >= outer.min.z && inner.max.z <= outer.max.z;
}

/// Returns whether the frustum's axis, from end to end, meets the cell, which is the fastest test
/// for a cell larger than the frustum. Rounding may give either answer at the margin; none is
/// wrong, since kCrosses is always allowed.
bool axis_meets(const CanonicalPrimitive& primitive, const Box& cell) {
  const Vec3& axis = primitive.canonical_to_world[2];
  double low = -1.0;
  double high = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double inverse = 1.0 / axis[i];  // makes ±inf bounds, or NaN, which min and max ignore
    const double a = (cell.min[i] - primitive.center[i]) * inverse;
    const double b = (cell.max[i] - primitive.center[i]) * inverse;
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  }
  return low <= high;
}

/// Returns approximately the cell's point nearest to the frustum's axis, by cyclic coordinate
/// descent in the three edge parameters.
Vec3 nearest_to_axis(const CanonicalCell& cell) {
  constexpr int kSweeps = 2;
  Vec3 parameter{0.0};
  Vec3 nearest = cell.center;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int i = 0; i < 3; ++i) {
      const Vec3& half = cell.half[i];
      const double length2 = half.x * half.x + half.y * half.y;
      if (length2 == 0) continue;
      const double moved = parameter[i] - (half.x * nearest.x + half.y * nearest.y) / length2;
      const double clamped = glm::clamp(moved, -1.0, 1.0);
      nearest += (clamped - parameter[i]) * half;
      parameter[i] = clamped;
    }
  }
  return nearest;
}

/// Returns whether the 8 corners, whose heights are known to be in range, lie inside. By convexity,
/// all of the cell then does.
bool holds_corners(const CanonicalPrimitive& primitive, const CanonicalCell& cell) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 point = cell.corner(corner);
    const double radius = primitive.radius_mid + primitive.radius_slope * point.z - cell.slack;
    if (!(radius >= 0 && point.x * point.x + point.y * point.y <= radius * radius)) return false;
  }
  return true;
}

/// Two frusta whose axes differ by no more than this, in canonical units, are coaxial up to
/// rounding.
constexpr double kCoaxial = 1e-14;

/// Implements lies_within() for two coaxial frusta, with `reach` in the outer one's canonical
/// units. Returns false for others.
bool frustum_lies_within(const CanonicalPrimitive& inner, const CanonicalPrimitive& outer,
                         double reach) {
  const Mat3 map = outer.world_to_canonical * inner.canonical_to_world;
  const Vec3 offset = outer.world_to_canonical * (inner.center - outer.center);
  const double radius = glm::length(map[0]);
  const double off_axis =
      std::max({std::abs(map[2].x), std::abs(map[2].y), std::abs(map[0].z), std::abs(map[1].z),
                std::abs(glm::dot(map[0], map[1])), std::abs(glm::length(map[1]) - radius),
                std::hypot(offset.x, offset.y)});
  if (!(off_axis <= kCoaxial)) return false;
  for (const double end : {-1.0, 1.0}) {
    const double z = offset.z + end * map[2].z;
    const double rim = radius * (inner.radius_mid + end * inner.radius_slope);
    if (std::abs(z) > 1 + reach) return false;
    if (rim > outer.radius_mid + outer.radius_slope * z + reach) return false;
  }
  return true;
}

/// Returns the direction across a frustum's axis that the map stretches most, along which an
/// elliptical cylinder is thinnest.
Vec3 most_stretched_across(const Vec3& row_x, const Vec3& row_y) {
  const double angle =
      0.5 * std::atan2(2 * glm::dot(row_x, row_y), glm::dot(row_x, row_x) - glm::dot(row_y, row_y));
  return std::cos(angle) * row_x + std::sin(angle) * row_y;
}

class FrustumKind final : public PrimitiveKind {
 public:
  bool has_valid_shape(const Primitive& primitive) const override {
    const auto& [z_min, z_max, r_bottom, r_top] = primitive.as<FrustumShape>();
    const double height = z_max - z_min;
    return std::isfinite(height) && height > 0 && std::isfinite(r_bottom) && std::isfinite(r_top) &&
           r_bottom >= 0 && r_top >= 0 && r_bottom + r_top > 0;
  }
  Mesh faceted_mesh(const Primitive& primitive, int fragments) const override {
    const auto& [z_min, z_max, r_bottom, r_top] = primitive.as<FrustumShape>();
    return frustum_mesh(z_min, z_max, r_bottom, r_top, fragments);
  }
  std::shared_ptr<const Polyhedron> faceted_polyhedron(const Primitive& primitive,
                                                       int fragments) const override {
    const auto& [z_min, z_max, r_bottom, r_top] = primitive.as<FrustumShape>();
    return Polyhedron::frustum(z_min, z_max, r_bottom, r_top, fragments);
  }

  CanonicalPrimitive canonicalize(const Primitive& primitive) const override {
    CanonicalPrimitive result;
    result.enclosure = Shape::kFrustum;
    const auto& [z_min, z_max, r_bottom, r_top] = primitive.as<FrustumShape>();
    const double radius = std::max(r_bottom, r_top);
    const double half_height = 0.5 * (z_max - z_min);
    const double middle = 0.5 * z_min + 0.5 * z_max;
    result.radius_mid = 0.5 * (r_bottom / radius + r_top / radius);
    result.radius_slope = 0.5 * (r_top / radius - r_bottom / radius);
    const Mat3& linear = primitive.local_to_world.linear;
    result.center = primitive.local_to_world.point({0, 0, middle});
    result.canonical_to_world =
        Mat3{linear[0] * radius, linear[1] * radius, linear[2] * half_height};
    result.world_to_canonical = inverse(result.canonical_to_world);
    // The bounds are those of the two end discs. A disc's support along a world axis is its radius
    // times the norm of the axis' row over the disc's two directions.
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

  bool holds_ball(const CanonicalPrimitive& primitive, const Vec3& p, double r) const override {
    const double depth = primitive.radius_mid + primitive.radius_slope * p.z - std::hypot(p.x, p.y);
    return std::abs(p.z) < 1 - r && depth > r * std::hypot(1.0, primitive.radius_slope);
  }

  Vec3 support(const CanonicalPrimitive& primitive, const Vec3& direction) const override {
    const double top = primitive.radius_mid + primitive.radius_slope;
    const double bottom = primitive.radius_mid - primitive.radius_slope;
    const double lateral = std::sqrt(direction.x * direction.x + direction.y * direction.y);
    const bool at_top = direction.z + lateral * top >= -direction.z + lateral * bottom;
    const double radius = at_top ? top : bottom;
    const double scale = lateral > 0 ? radius / lateral : 0.0;
    return {direction.x * scale, direction.y * scale, at_top ? 1.0 : -1.0};
  }

  bool contains(const CanonicalPrimitive& primitive, const Vec3& p) const override {
    const double radius = primitive.radius_mid + primitive.radius_slope * p.z;
    return std::abs(p.z) <= 1.0 && radius >= 0 && p.x * p.x + p.y * p.y <= radius * radius;
  }

  Classification classify(const CanonicalPrimitive& primitive,
                          const Box& cell_world) const override {
    if (!within(cell_world, primitive.bounds) && axis_meets(primitive, cell_world)) {
      return Classification::kCrosses;
    }
    const CanonicalCell cell = to_canonical(primitive, cell_world);
    const Vec3& center = cell.center;
    const double z_reach =
        std::abs(cell.half[0].z) + std::abs(cell.half[1].z) + std::abs(cell.half[2].z);
    if (std::abs(center.z) - z_reach > 1.0 + cell.slack) return Classification::kOutside;
    if (contains(primitive, center)) {
      const bool between_ends = std::abs(center.z) + z_reach < 1.0 - cell.slack;
      return between_ends && holds_corners(primitive, cell) ? Classification::kInside
                                                            : Classification::kCrosses;
    }

    // Search for a separating direction, starting from the wall's normal on the cell's side. Each
    // step reflects it at the plane between the two supporting points (Chung and Wang, "Quick
    // collision detection of polytopes in virtual environments", 1996), and may find a proof.
    constexpr int kSteps = 5;
    const Vec3 nearest = nearest_to_axis(cell);
    if (contains(primitive, nearest)) return Classification::kCrosses;
    const double lateral = std::sqrt(nearest.x * nearest.x + nearest.y * nearest.y);
    Vec3 direction = lateral > 0
                         ? Vec3{nearest.x / lateral, nearest.y / lateral, -primitive.radius_slope}
                         : Vec3{0, 0, center.z > 0 ? 1.0 : -1.0};
    direction /= std::sqrt(glm::dot(direction, direction));
    for (int step = 0; step < kSteps; ++step) {
      const Vec3 near = cell.lowest(direction);
      if (contains(primitive, near)) return Classification::kCrosses;
      const Vec3 gap = near - support(primitive, direction);
      const double along = glm::dot(gap, direction);
      if (along > cell.slack) return Classification::kOutside;
      direction -= (2.0 * along / glm::dot(gap, gap)) * gap;
    }
    return Classification::kCrosses;
  }

  bool holds(const CanonicalPrimitive& outer, const CanonicalPrimitive& inner,
             double limit) const override {
    if (inner.shape == Shape::kFrustum) {
      // canonical_stretch bounds canonical lengths over world lengths.
      const double reach = limit > 0 ? kCoaxial : limit * outer.canonical_stretch;
      if (frustum_lies_within(inner, outer, reach)) return true;
    }
    return PrimitiveKind::holds(outer, inner, limit);
  }

  Vec3 outwards(const CanonicalPrimitive& primitive, const Vec3& p) const override {
    const double lateral = std::sqrt(p.x * p.x + p.y * p.y);
    const double above_wall = lateral - primitive.radius_mid - primitive.radius_slope * p.z;
    if (lateral == 0 || std::abs(p.z) - 1 > above_wall) return {0, 0, p.z > 0 ? 1.0 : -1.0};
    return {p.x / lateral, p.y / lateral, -primitive.radius_slope};
  }

  bool is_thinner(const CanonicalPrimitive& primitive, double thickness) const override {
    // A cylinder is at least 2 thick in every direction of canonical space, and so at least
    // 2/canonical_stretch in world space. This may miss thin cones, which the interface allows.
    if (primitive.canonical_stretch * thickness <= 2) return false;
    const Mat3 rows = glm::transpose(primitive.world_to_canonical);
    return width(primitive, rows[2]) < thickness ||
           width(primitive, most_stretched_across(rows[0], rows[1])) < thickness;
  }
};

constexpr FrustumKind kFrustumKind;

}  // namespace

constinit const PrimitiveKind& Frustum_kind = kFrustumKind;

}  // namespace csgcore
