#include "primitives/primitive_kind.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "base/constants.hpp"
#include "csgcore/canonical_primitive.hpp"

namespace csgcore {

// The file of each kind defines its constant.
#define CSGCORE_DECLARE(Name) extern const PrimitiveKind& Name##_kind;
CSGCORE_FOR_EACH_SHAPE(CSGCORE_DECLARE)
#undef CSGCORE_DECLARE

const PrimitiveKind& kind_of(Shape shape) {
  switch (shape) {
#define CSGCORE_CASE(Name) \
  case Shape::k##Name:     \
    return Name##_kind;
    CSGCORE_FOR_EACH_SHAPE(CSGCORE_CASE)
#undef CSGCORE_CASE
  }
  throw std::logic_error("a shape that is none");
}

namespace {

/// Classifies a box against a ball by the distances of its nearest and its furthest point.
Classification classify_ball(const Vec3& center, double radius, const Box& cell) {
  double nearest2 = 0;
  double furthest2 = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = cell.min[axis] - center[axis];
    const double above = center[axis] - cell.max[axis];
    const double gap = std::max(std::max(below, above), 0.0);
    nearest2 += gap * gap;
    const double reach = std::max(-below, -above);  // distance to the far side
    furthest2 += reach * reach;
  }
  const double radius2 = radius * radius;
  if (nearest2 > radius2 * (1.0 + kCanonicalSlack)) return Classification::kOutside;
  if (furthest2 < radius2 * (1.0 - kCanonicalSlack)) return Classification::kInside;
  return Classification::kCrosses;
}

double largest_row_sum(const Mat3& m) {
  const Vec3 sums = glm::abs(m[0]) + glm::abs(m[1]) + glm::abs(m[2]);
  return std::max({sums.x, sums.y, sums.z});
}

Mat3 absolute(const Mat3& m) { return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])}; }

/// kTermRounding bounds the relative rounding of a canonical coordinate: that of the cell's middle,
/// of its offset from the primitive, and of three products.
constexpr double kTermRounding = 8 * kEpsilon;

/// If W is the rounded inverse of C, the computed canonical coordinates are W·C·x for the true x,
/// and their relative error is W·C − 1. That in turn is computed as sums of three rounded products.
double inversion_error(const CanonicalPrimitive& primitive) {
  const Mat3& w = primitive.world_to_canonical;
  const Mat3& c = primitive.canonical_to_world;
  return largest_row_sum(w * c - Mat3{1.0}) +
         4 * kEpsilon * largest_row_sum(absolute(w) * absolute(c));
}

float rounded_up(double bound) {
  return std::nextafter(static_cast<float>(bound), std::numeric_limits<float>::infinity());
}

/// Returns the bounds of a primitive whose centre and maps are set, by its support.
Box bounds_of(const PrimitiveKind& kind, const CanonicalPrimitive& primitive) {
  // The support along a world axis is that of the canonical solid along the axis' row of the map.
  const Mat3 rows = glm::transpose(primitive.canonical_to_world);
  Box bounds;
  for (int axis = 0; axis < 3; ++axis) {
    const auto reach = [&](const Vec3& direction) {
      return glm::dot(direction, kind.support(primitive, direction));
    };
    bounds.min[axis] = primitive.center[axis] - reach(-rows[axis]);
    bounds.max[axis] = primitive.center[axis] + reach(rows[axis]);
  }
  return bounds;
}

/// Returns a bound of the rounding of a cell's canonical coordinates. `terms` bounds the world
/// coordinates that they are computed from. A quick bound is enough if it is small; maps that are
/// nearly singular need the sharp one.
double canonical_slack(const CanonicalPrimitive& primitive, const CanonicalCell& cell,
                       const Vec3& terms) {
  constexpr double kSmall = 1e-9;  // cells are much larger than this share of a primitive
  const double quick = primitive.canonical_error * largest(terms);
  if (quick < kSmall) return kCanonicalSlack + quick;
  const Vec3 sums = glm::abs(cell.center) + absolute(cell.half) * Vec3{1.0};
  return kCanonicalSlack + kTermRounding * largest(absolute(primitive.world_to_canonical) * terms) +
         primitive.inversion_error * largest(sums);
}

}  // namespace

Mesh PrimitiveKind::faceted_mesh(const Primitive&, int) const { return {}; }

std::shared_ptr<const Polyhedron> PrimitiveKind::faceted_polyhedron(const Primitive&, int) const {
  return nullptr;
}

bool PrimitiveKind::has_same_solid(const Primitive& a, const Primitive& b) const {
  return a.solid == b.solid;
}

bool PrimitiveKind::has_same_form(const CanonicalPrimitive& a, const CanonicalPrimitive& b) const {
  return a.polyhedron == b.polyhedron && a.shared_shape == b.shared_shape;
}

std::array<double, 2> PrimitiveKind::shader_numbers(const CanonicalPrimitive& primitive) const {
  return {primitive.radius_mid, primitive.radius_slope};
}

Vec3 PrimitiveKind::support(const CanonicalPrimitive& primitive, const Vec3& direction) const {
  return kind_of(primitive.enclosure).support(primitive, direction);
}

bool PrimitiveKind::holds_ball(const CanonicalPrimitive&, const Vec3&, double) const {
  return false;
}

Classification PrimitiveKind::classify(const CanonicalPrimitive& primitive, const Box& cell) const {
  const Classification enclosure = kind_of(primitive.enclosure).classify(primitive, cell);
  return enclosure == Classification::kOutside ? enclosure : Classification::kCrosses;
}

bool PrimitiveKind::holds(const CanonicalPrimitive& outer, const CanonicalPrimitive& inner,
                          double limit) const {
  return csgcore::holds_ball(outer, inner.center, reach(inner) + std::max(-limit, 0.0));
}

Vec3 PrimitiveKind::outwards(const CanonicalPrimitive&, const Vec3&) const { return Vec3(0.0); }

bool PrimitiveKind::is_thinner(const CanonicalPrimitive&, double) const { return false; }

bool has_valid_shape(const Primitive& primitive) {
  return kind_of(primitive.shape()).has_valid_shape(primitive);
}

bool is_valid(const Primitive& primitive) {
  if (!primitive.local_to_world.finite()) return false;
  const double determinant = primitive.local_to_world.determinant();
  if (!std::isfinite(determinant) || determinant == 0) return false;
  // The inverse must be representable, too: a matrix so small that it is not flattens the solid.
  if (!Affine{inverse(primitive.local_to_world.linear), Vec3{0.0}}.finite()) return false;
  return has_valid_shape(primitive);
}

CanonicalPrimitive canonicalize(const Primitive& primitive) {
  const PrimitiveKind& kind = kind_of(primitive.shape());
  CanonicalPrimitive result = kind.canonicalize(primitive);
  result.shape = primitive.shape();
  result.is_convex = is_convex(result.shape);
  if (result.bounds.empty()) result.bounds = bounds_of(kind, result);
  const Mat3& map = result.world_to_canonical;
  result.canonical_stretch =
      std::sqrt(glm::dot(map[0], map[0]) + glm::dot(map[1], map[1]) + glm::dot(map[2], map[2]));
  const double from_inversion = inversion_error(result);
  result.inversion_error = rounded_up(from_inversion);
  result.canonical_error =
      (kTermRounding + from_inversion) * largest_row_sum(result.world_to_canonical);
  result.color = primitive.color;
  result.cut_faces = primitive.cut_faces;
  result.id = primitive.id;
  return result;
}

Mesh faceted_mesh(const Primitive& primitive, int fragments) {
  return kind_of(primitive.shape()).faceted_mesh(primitive, fragments);
}

std::shared_ptr<const Polyhedron> faceted_polyhedron(const Primitive& primitive, int fragments) {
  return kind_of(primitive.shape()).faceted_polyhedron(primitive, fragments);
}

std::array<double, 2> shader_numbers(const CanonicalPrimitive& primitive) {
  return kind_of(primitive.shape).shader_numbers(primitive);
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
  return kind_of(primitive.shape).classify(primitive, cell);
}

CanonicalCell to_canonical(const CanonicalPrimitive& primitive, const Box& cell) {
  const Vec3 half = 0.5 * (cell.max - cell.min);
  const Vec3 middle = cell.center();
  const Vec3 offset = middle - primitive.center;
  const Mat3& map = primitive.world_to_canonical;
  CanonicalCell canonical;
  canonical.center = map * offset;
  canonical.half = Mat3{map[0] * half.x, map[1] * half.y, map[2] * half.z};
  canonical.slack =
      canonical_slack(primitive, canonical, glm::abs(offset) + half + glm::abs(middle));
  return canonical;
}

namespace {

double largest_coordinate(const CanonicalPrimitive& primitive) {
  return largest(glm::max(glm::abs(primitive.bounds.min), glm::abs(primitive.bounds.max)));
}

}  // namespace

Vec3 furthest_point(const CanonicalPrimitive& primitive, const Vec3& direction_world) {
  const Vec3 direction = direction_world * primitive.canonical_to_world;
  const Vec3 furthest = kind_of(primitive.shape).support(primitive, direction);
  return primitive.center + primitive.canonical_to_world * furthest;
}

double reach(const CanonicalPrimitive& primitive) {
  if (primitive.ball_radius > 0) return primitive.ball_radius;
  const Mat3& map = primitive.canonical_to_world;
  const Mat3 gram = absolute(glm::transpose(map) * map);
  if (primitive.enclosure == Shape::kSphere) return std::sqrt(largest_row_sum(gram));
  // The furthest points lie on the rims, (r cos φ, r sin φ, ±1).
  const double lateral2 = std::max(gram[0][0], gram[1][1]) + gram[0][1];
  const double r = primitive.radius_mid + std::abs(primitive.radius_slope);
  return std::sqrt(r * r * lateral2 + gram[2][2] + 2 * r * std::hypot(gram[2][0], gram[2][1]));
}

bool holds_ball(const CanonicalPrimitive& primitive, const Vec3& center_world, double radius) {
  const Vec3 offset = center_world - primitive.center;
  if (primitive.ball_radius > 0) {
    const double rounding =
        kTermRounding * (largest_coordinate(primitive) + largest(glm::abs(center_world)));
    return glm::length(offset) < primitive.ball_radius - radius - rounding;
  }
  const Vec3 center = primitive.world_to_canonical * offset;
  const double terms = largest(glm::abs(offset) + glm::abs(center_world));
  const double canonical_radius =
      radius * primitive.canonical_stretch + kCanonicalSlack + primitive.canonical_error * terms;
  return kind_of(primitive.shape).holds_ball(primitive, center, canonical_radius);
}

bool contains(const CanonicalPrimitive& primitive, const Vec3& point_world) {
  const Vec3 point = primitive.world_to_canonical * (point_world - primitive.center);
  return kind_of(primitive.shape).contains(primitive, point);
}

bool lies_within(const CanonicalPrimitive& inner, const CanonicalPrimitive& outer, double limit) {
  if (outer.ball_radius > 0) {
    return glm::length(inner.center - outer.center) + reach(inner) <= outer.ball_radius + limit;
  }
  return kind_of(outer.shape).holds(outer, inner, limit);
}

double width(const CanonicalPrimitive& primitive, const Vec3& direction) {
  const Vec3 across = glm::normalize(direction);
  return glm::dot(across, furthest_point(primitive, across) - furthest_point(primitive, -across));
}

bool is_thinner(const CanonicalPrimitive& primitive, double thickness) {
  return kind_of(primitive.shape).is_thinner(primitive, thickness);
}

/// The bounds of a primitive are computed with a few roundings of its coordinates, which this share
/// of the coordinates and the slack of the primitive's size cover.
constexpr double kBoxRounding = 8 * std::numeric_limits<double>::epsilon();

Extent extent_of(const CanonicalPrimitive& primitive) {
  Extent extent;
  const Box& bounds = primitive.bounds;
  for (int axis = 0; axis < 3; ++axis) {
    const double center = primitive.ball_radius > 0
                              ? primitive.center[axis]
                              : 0.5 * bounds.min[axis] + 0.5 * bounds.max[axis];
    const double half = std::max(bounds.max[axis] - center, center - bounds.min[axis]);
    extent.center[axis] = center;
    extent.half[axis] = half * (1.0 + kCanonicalSlack) + std::abs(center) * kBoxRounding;
  }
  const double radius2 = primitive.ball_radius * primitive.ball_radius;
  const bool is_ball = primitive.ball_radius > 0;
  extent.outside2 =
      is_ball ? radius2 * (1.0 + kCanonicalSlack) : std::numeric_limits<double>::infinity();
  extent.inside2 = is_ball ? radius2 * (1.0 - kCanonicalSlack) : -1.0;
  return extent;
}

}  // namespace csgcore
