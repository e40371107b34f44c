#include "special_rays.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "checks.hpp"

namespace csgcore::checks {

const char* name_of(RayKind kind) {
  constexpr const char* kNames[kRayKinds] = {
      "Any",         "Tangent",           "AlongAxis",
      "InCapPlane",  "ThroughRim",        "AlongGeneratrix",
      "ThroughApex", "LevelButForATrace", "UprightButForATrace"};
  return kNames[static_cast<int>(kind)];
}

namespace {

double size_of(const test_support::TestKind& kind, const Primitive& primitive) {
  const auto [low, high] = kind.heights(primitive);
  const Vec3 sideways(1, 0, 0);
  return std::max({kind.on_surface(primitive, sideways, low).x,
                   kind.on_surface(primitive, sideways, high).x, high - low});
}

}  // namespace

SpecialRays::SpecialRays(const Primitive& primitive, const Vec3& pivot, std::mt19937& random)
    : primitive_(primitive),
      map_(primitive.local_to_world),
      pivot_(pivot),
      random_(random),
      kind_(test_support::test_kind_of(primitive.shape())),
      z_min_(kind_.heights(primitive).low),
      z_max_(kind_.heights(primitive).high),
      size_(size_of(kind_, primitive)) {}

std::vector<PivotRay> SpecialRays::next(RayKind kind) {
  std::vector<PivotRay> rays;
  while (rays.size() < kPacketRays) {
    const PivotRay ray = make(kind);
    // Two equal points define no line.
    if (ray.direction != Vec3{0.0}) rays.push_back(ray);
  }
  return rays;
}

PivotRay SpecialRays::make(RayKind kind) {
  switch (kind) {
    case RayKind::kAny:
      return any();
    case RayKind::kTangent:
      return tangent();
    case RayKind::kAlongAxis:
      return along_axis();
    case RayKind::kInCapPlane:
      return in_cap_plane();
    case RayKind::kThroughRim:
      return through_rim();
    case RayKind::kAlongGeneratrix:
      return along_generatrix();
    case RayKind::kThroughApex:
      return through_apex();
    case RayKind::kLevelButForATrace:
      return level_but_for_a_trace();
    case RayKind::kUprightButForATrace:
      return upright_but_for_a_trace();
  }
  return any();
}

double SpecialRays::pick(double low, double high) { return uniform(random_, low, high); }

Vec3 SpecialRays::any_direction() { return random_direction(random_); }

Vec3 SpecialRays::sideways() {
  if (chance(0.3)) {
    constexpr Vec3 kAxes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    return kAxes[random_() % std::size(kAxes)];
  }
  const double angle = pick(0, 2 * std::acos(-1.0));
  return {std::cos(angle), std::sin(angle), 0};
}

double SpecialRays::trace() {
  constexpr double kTraces[] = {5e-324, 1e-320, 1e-310, 3e-308, 1e-300, 1e-200, 1e-160,
                                1e-155, 1e-150, 1e-100, 1e-30,  1e-17,  1e-16,  1e-15};
  return (chance(0.5) ? 1 : -1) * kTraces[random_() % std::size(kTraces)];
}

double SpecialRays::near_miss() {
  if (chance(0.2)) return 0;
  return (chance(0.5) ? 1 : -1) * size_ * std::pow(10, pick(-17, -6));
}

PivotRay SpecialRays::through(const Vec3& point_local, const Vec3& direction_local) {
  const double length = std::pow(10, pick(-2, 2));
  const Vec3 direction = map_.direction(direction_local * length);
  const Vec3 point = map_.direction(point_local) + (map_.translation - pivot_);
  if (chance(0.3)) return {point, direction};
  return {point - pick(-3, 3) * size_ / length * direction, direction};
}

PivotRay SpecialRays::any() {
  return through(on_surface(pick(0, 1.5) * sideways(), any_height()), any_direction());
}

PivotRay SpecialRays::tangent() {
  const Vec3 aside = sideways();
  const Vec3 point = on_surface(aside, any_height());
  const Vec3 around{-aside.y, aside.x, 0};
  const Vec3 upwards = kind_.upwards(primitive_, aside, point);
  const Vec3 normal = glm::normalize(glm::cross(around, upwards));
  const double kind = pick(0, 1);
  const Vec3 direction = kind < 0.3   ? around
                         : kind < 0.6 ? upwards
                                      : around + pick(-2, 2) * upwards;
  return through(point + near_miss() * normal, direction);
}

PivotRay SpecialRays::along_axis() {
  const double share = chance(0.2) ? 0 : chance(0.3) ? 1 : pick(0, 1.1);
  const Vec3 point = on_surface(share * sideways(), any_height());
  return through(point, {0, 0, chance(0.5) ? 1 : -1});
}

PivotRay SpecialRays::in_cap_plane() {
  Vec3 point = on_surface(pick(0, 1.2) * sideways(), chance(0.5) ? z_min_ : z_max_);
  if (chance(0.5)) point.z += near_miss();
  return through(point, sideways());
}

PivotRay SpecialRays::through_rim() {
  const Vec3 point = on_surface(sideways(), chance(0.5) ? z_min_ : z_max_);
  return through(point, chance(0.3) ? sideways() : any_direction());
}

PivotRay SpecialRays::along_generatrix() {
  const Vec3 aside = sideways();
  const Vec3 direction = generatrix(aside);
  const Vec3 around{-aside.y, aside.x, 0};
  const double kind = pick(0, 1);
  Vec3 point = on_surface(aside, any_height());
  if (kind < 0.3) point += pick(-1, 1) * around;  // beside it, in the plane that touches the wall
  if (kind > 0.6) point = on_surface(pick(0, 1.2) * sideways(), any_height());
  return through(point, direction);
}

PivotRay SpecialRays::through_apex() {
  // The ray goes through the point where the wall's lines meet, inside the primitive or not; if
  // there is none, through some point of the axis.
  const double apex = kind_.apex(primitive_).value_or(any_height());
  const Vec3 point{0, 0, apex};
  const double kind = pick(0, 1);
  const Vec3 direction = kind < 0.2   ? sideways()
                         : kind < 0.4 ? on_surface(sideways(), any_height()) - point
                                      : any_direction();
  return through(point + near_miss() * any_direction(), direction);
}

PivotRay SpecialRays::level_but_for_a_trace() {
  Vec3 point = on_surface(pick(0, 1.2) * sideways(), any_height());
  if (chance(0.3)) point.z += pick(-1, 1) * (z_max_ - z_min_);
  return through(point, sideways() + Vec3{0, 0, trace()});
}

PivotRay SpecialRays::upright_but_for_a_trace() {
  const Vec3 point = on_surface(pick(0, 1.2) * sideways(), any_height());
  return through(point, trace() * sideways() + Vec3{0, 0, 1});
}

}  // namespace csgcore::checks
