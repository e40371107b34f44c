#include "reference_primitive.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "kinds/test_kind.hpp"

namespace csgcore::reference {
namespace {

using test_support::test_kind_of;

/// Planes cull a primitive only if it is clear of them by this share of its distance from the
/// plane's origin and of its size, plus the rounding of the coordinates, so that culling never
/// changes a hit.
constexpr double kCullingSlack = 1e-9;
constexpr double kCoordinateSlack = 16 * std::numeric_limits<double>::epsilon();

}  // namespace

LongVec3 exact_offset(const Vec3& a, double s, const Vec3& d, const Vec3& b) {
  LongVec3 result;
  for (int i = 0; i < 3; ++i) result[i] = Real(Wide(s) * Wide(d[i]) + (Wide(a[i]) - Wide(b[i])));
  return result;
}

RayTarget::RayTarget(const Primitive& primitive, const Vec3& pivot)
    : solid_(test_kind_of(primitive.shape()).solid(primitive)),
      world_to_local_(glm::inverse(LongMat3(primitive.local_to_world.linear))) {
  const Affine& map = primitive.local_to_world;
  for (int i = 0; i < 3; ++i) {
    middle_to_pivot_[i] = Real((Wide(pivot[i]) - Wide(map.translation[i])) -
                               Wide(map.linear[2][i]) * solid_->middle_z());
  }
}

NearRay RayTarget::localize(const NearRay& ray) const {
  return {world_to_local_ * (ray.origin + middle_to_pivot_), world_to_local_ * ray.direction};
}

void RayTarget::add_spans(const NearRay& ray, Real thickness, std::vector<Span>& spans) const {
  solid_->add_spans(localize(ray), thickness, spans);
}

LongVec3 RayTarget::normal(const NearRay& ray, Real t, Surface surface) const {
  const NearRay local = localize(ray);
  const LongVec3 normal = solid_->normal(local.origin + t * local.direction, surface);
  return glm::normalize(glm::transpose(world_to_local_) * normal);
}

double furthest(const Primitive& p, const HalfSpace& half_space) {
  const Vec3& normal = half_space.normal;
  const Vec3 local = glm::transpose(p.local_to_world.linear) * normal;
  const double base = glm::dot(p.local_to_world.translation - half_space.point, normal);
  return base + test_kind_of(p.shape()).furthest(p, local);
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
