#include "reference_primitive.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "csgcore/polyhedron.hpp"

namespace csgcore::reference {
namespace {

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

/// Products of two doubles and sums of them that cancel to the last bit: 113 bits. Where a compiler
/// has no such type, long double has them (AArch64).
#ifdef __SIZEOF_FLOAT128__
__extension__ using Wide = __float128;
#else
using Wide = long double;
#endif

/// Planes cull a primitive only when it is clear of them by this share of its distance from the
/// plane's origin and of its size, and by the rounding of the coordinates, so that culling never
/// changes a hit.
constexpr double kCullingSlack = 1e-9;
constexpr double kCoordinateSlack = 16 * std::numeric_limits<double>::epsilon();

/// The roots' side of a cone: f(t) = a·t² + 2b·t + c ≤ 0 on the nappe of positive radius. a > 0 is
/// one segment; a < 0 is two half-lines, one in each nappe, of which the radius's growth along the
/// ray tells ours; a = 0 is one half-line.
Span solve_cone(Real a, Real b, Real c, Real growth) {
  if (a == 0) {
    if (b == 0) return c <= 0 ? Span{-kInfinity, kInfinity} : Span{};
    return b > 0 ? Span{-kInfinity, -c / (2 * b)} : Span{-c / (2 * b), kInfinity};
  }
  Real discriminant = b * b - a * c;
  if (discriminant < 0) {
    if (a > 0) return {};
    discriminant = 0;  // rounding: at the apex's height f ≥ 0, so for a < 0 there are roots
  }
  const Real q = -(b + std::copysign(std::sqrt(discriminant), b));
  if (q == 0) return a > 0 ? Span{} : growth > 0 ? Span{0, kInfinity} : Span{-kInfinity, 0};
  const Real low = std::min(q / a, c / q), high = std::max(q / a, c / q);
  if (a > 0) return {low, high};
  return growth > 0 ? Span{high, kInfinity} : Span{-kInfinity, low};
}

/// The part of the ray with |z| ≤ half_height; a ray along the end planes belongs to it.
Span cross_slab(const NearRay& ray, Real half_height) {
  if (ray.direction.z == 0) {
    const bool inside = std::abs(ray.origin.z) <= half_height;
    return inside ? Span{-kInfinity, kInfinity} : Span{};
  }
  const Real at_bottom = (-half_height - ray.origin.z) / ray.direction.z;
  const Real at_top = (half_height - ray.origin.z) / ray.direction.z;
  if (at_bottom < at_top) return {at_bottom, at_top, Surface::kBottom, Surface::kTop};
  return {at_top, at_bottom, Surface::kTop, Surface::kBottom};
}

}  // namespace

LongVec3 exact_offset(const Vec3& a, double s, const Vec3& d, const Vec3& b) {
  LongVec3 result;
  for (int i = 0; i < 3; ++i) result[i] = Real(Wide(s) * Wide(d[i]) + (Wide(a[i]) - Wide(b[i])));
  return result;
}

RayTarget::RayTarget(const Primitive& primitive, const Vec3& pivot)
    : shape_(primitive.shape),
      polyhedron_(primitive.polyhedron),
      world_to_local_(glm::inverse(LongMat3(primitive.local_to_world.linear))),
      r_bottom_(primitive.r_bottom),
      r_top_(primitive.r_top) {
  Wide middle = 0;
  if (shape_ == Shape::kFrustum) {
    middle = (Wide(primitive.z_min) + Wide(primitive.z_max)) / 2;
    half_height_ = Real((Wide(primitive.z_max) - Wide(primitive.z_min)) / 2);
    slope_ = (r_top_ - r_bottom_) / (2 * half_height_);
  }
  const Affine& map = primitive.local_to_world;
  for (int i = 0; i < 3; ++i) {
    middle_to_pivot_[i] =
        Real((Wide(pivot[i]) - Wide(map.translation[i])) - Wide(map.linear[2][i]) * middle);
  }
}

NearRay RayTarget::localize(const NearRay& ray) const {
  return {world_to_local_ * (ray.origin + middle_to_pivot_), world_to_local_ * ray.direction};
}

Span RayTarget::cross_sphere(const NearRay& local) const {
  const Real dd = glm::dot(local.direction, local.direction);
  const Real closest = -glm::dot(local.origin, local.direction) / dd;
  const LongVec3 foot = local.origin + closest * local.direction;
  const Real half_squared = (r_bottom_ * r_bottom_ - glm::dot(foot, foot)) / dd;
  if (!(half_squared > 0)) return {};
  const Real half = std::sqrt(half_squared);
  return {closest - half, closest + half};
}

/// From the nearer end, so that next to an apex nothing cancels.
Real RayTarget::radius_at(Real z) const {
  return z > 0 ? r_top_ + slope_ * (z - half_height_) : r_bottom_ + slope_ * (z + half_height_);
}

Span RayTarget::cross_frustum(const NearRay& local) const {
  Span span = cross_slab(local, half_height_);
  if (span.empty()) return span;
  // The wall as seen from the ray's point next to the axis within the slab: what is subtracted
  // there is of the primitive's own size, be it ever so long and thin.
  const LongVec3& d = local.direction;
  const Real dd = d.x * d.x + d.y * d.y;
  const Real next_to_axis = dd > 0 ? -(local.origin.x * d.x + local.origin.y * d.y) / dd : Real(0);
  const Real base = std::clamp(next_to_axis, span.begin, span.end);
  const LongVec3 o = local.origin + base * d;
  const Real radius = radius_at(o.z), growth = slope_ * d.z;
  const Span side = solve_cone(dd - growth * growth, o.x * d.x + o.y * d.y - radius * growth,
                               o.x * o.x + o.y * o.y - radius * radius, growth);
  if (side.empty()) return {};
  const Real begin = base + side.begin, end = base + side.end;
  if (begin > span.begin) span.begin = begin, span.begin_surface = Surface::kSide;
  if (end < span.end) span.end = end, span.end_surface = Surface::kSide;
  return span;
}

Span RayTarget::cross_polyhedron(const NearRay& local) const {
  Span span{-kInfinity, kInfinity};
  const std::vector<csgcore::HalfSpace>& faces = polyhedron_->half_spaces();
  for (size_t i = 0; i < faces.size(); ++i) {
    const LongVec3 normal(faces[i].normal);
    const Real room = Real(faces[i].offset) - glm::dot(normal, local.origin);
    const Real ascent = glm::dot(normal, local.direction);
    if (ascent == 0 && room < 0) return {};
    const Real t = room / ascent;
    if (ascent < 0 && t > span.begin) span.begin = t, span.begin_surface = Surface(i);
    if (ascent > 0 && t < span.end) span.end = t, span.end_surface = Surface(i);
  }
  return span;
}

Span RayTarget::span(const NearRay& ray) const {
  const NearRay local = localize(ray);
  switch (shape_) {
    case Shape::kSphere:
      return cross_sphere(local);
    case Shape::kFrustum:
      return cross_frustum(local);
    case Shape::kPolyhedron:
      break;
  }
  return cross_polyhedron(local);
}

LongVec3 RayTarget::normal(const NearRay& ray, Real t, Surface surface) const {
  const NearRay local = localize(ray);
  LongVec3 normal = local.origin + t * local.direction;
  if (shape_ == Shape::kPolyhedron) {
    normal = LongVec3(polyhedron_->half_spaces()[uint32_t(surface)].normal);
    return glm::normalize(glm::transpose(world_to_local_) * normal);
  }
  if (surface == Surface::kBottom) normal = LongVec3(0, 0, -1);
  if (surface == Surface::kTop) normal = LongVec3(0, 0, 1);
  if (surface == Surface::kSide && shape_ == Shape::kFrustum) {
    normal.z = -slope_ * std::hypot(normal.x, normal.y);
    // At the very apex every direction on the cone is as good: the axis.
    if (normal == LongVec3(0)) normal.z = r_top_ == 0 ? 1 : -1;
  }
  return glm::normalize(glm::transpose(world_to_local_) * normal);
}

double furthest(const Primitive& p, const HalfSpace& half_space) {
  const Vec3& normal = half_space.normal;
  const Vec3 local = glm::transpose(p.local_to_world.linear) * normal;
  const double base = glm::dot(p.local_to_world.translation - half_space.point, normal);
  if (p.shape == Shape::kSphere) return base + p.r_bottom * glm::length(local);
  if (p.shape == Shape::kPolyhedron) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : p.polyhedron->vertices()) most = std::max(most, glm::dot(local, v));
    return base + most;
  }
  const double across = std::hypot(local.x, local.y);
  return base +
         std::max(local.z * p.z_min + across * p.r_bottom, local.z * p.z_max + across * p.r_top);
}

bool reaches(const Primitive& p, const HalfSpace& half_space) {
  const double high = furthest(p, half_space);
  const Vec3& at = p.local_to_world.translation;
  const double coordinates = glm::length(at) + glm::length(half_space.point);
  const double slack =
      kCullingSlack * glm::length(at - half_space.point) + kCoordinateSlack * coordinates;
  return high >= -(slack * glm::length(half_space.normal) + kCullingSlack * std::abs(high));
}

}  // namespace csgcore::reference
