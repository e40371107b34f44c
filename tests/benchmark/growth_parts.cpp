#include "growth_parts.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "growth_scenes.hpp"

namespace frame_benchmark {
namespace {

using csgcore::Mat3;
using csgcore::Op;
using csgcore::View;

/// The radius in CSn with n = 2000, half of whose spheres are seen.
const double kHole = 20 / std::sqrt(2.0 * kVisiblePrimitives);

/// Returns a rotation whose third column is `axis`.
Mat3 turned_to(const Vec3& axis) {
  const Vec3 helper = std::abs(axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 x = glm::normalize(glm::cross(helper, axis));
  return Mat3{x, glm::cross(axis, x), axis};
}

}  // namespace

double distance_to_body() { return glm::length(growth_view().eye); }

double pixel_at_body() {
  return 2 * growth_view().half_height / growth_view().height_px * distance_to_body();
}

double aspect() { return double(growth_view().width_px) / growth_view().height_px; }

Vec3 on_screen(double across, double upwards, double depth) {
  const View& view = growth_view();
  return view.eye +
         depth * (view.forward + view.half_height * (across * view.right + upwards * view.up));
}

double plate_depth() { return distance_to_body() - kHalfPlate; }

bool is_in_core(const Place& place) {
  const Vec3& p = place.center;
  const double core = kBody - 1.01 * kHole - place.reach;
  return std::hypot(p.x, p.y) < core && std::abs(p.z) < core;
}

bool is_off_body(const Place& place) {
  const Vec3& p = place.center;
  const double body = kBody + place.reach;
  return std::hypot(p.x, p.y) > body || std::abs(p.z) > body;
}

/// Looks on the way to the centre, up to two reaches before it, for a point about which a ball of
/// the same reach is in the core.
bool is_in_shadow(const Place& place) {
  constexpr int kSteps = 200;
  const Vec3 eye = growth_view().eye;
  const Vec3 way = place.center - eye;
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 p = eye + (double(i) / kSteps) * way;
    if (glm::length(place.center - p) < 2 * place.reach) return false;
    if (is_in_core({p, place.reach})) return true;
  }
  return false;
}

Vec3 Composer::direction() {
  const double z = uniform(-1, 1);
  const double angle = uniform(0, 2 * std::numbers::pi);
  const double level = std::sqrt(1 - z * z);
  return {level * std::cos(angle), level * std::sin(angle), z};
}

void Composer::add(csgcore::Primitive primitive) {
  primitive.id = static_cast<uint32_t>(scene_.primitives.size());
  tree_.primitive(primitive.id);
  scene_.primitives.push_back(primitive);
}

void Composer::add_ball(const Place& place) {
  add(csgcore::make_sphere(place.reach, {Mat3{1.0}, place.center}));
}

void Composer::add_part(const Place& place) {
  if (toss()) {
    add_ball(place);
    return;
  }
  const double half = place.reach / std::numbers::sqrt2;
  const double top = toss() ? half : 0;
  add(csgcore::make_frustum(-half, half, half, top, {turned_to(direction()), place.center}));
}

void Composer::open_body() {
  open(Op::kDifference);
  add(csgcore::make_frustum(-kBody, kBody, kBody, kBody));
  for (uint32_t i = 1; i < kVisiblePrimitives;) {
    const SurfacePoint point = anywhere_on_body();
    if (glm::dot(point.normal, growth_view().eye - point.position) < 0) continue;
    add_ball({point.position, kHole});
    ++i;
  }
}

void Composer::open_plate(double radius) {
  const View& view = growth_view();
  open(Op::kDifference);
  add(csgcore::make_frustum(-kHalfPlate, kHalfPlate, radius, radius,
                            {Mat3{view.right, view.up, -view.forward}, Vec3{0.0}}));
  for (uint32_t i = 1; i < kVisiblePrimitives; ++i) {
    const double across = uniform(-aspect(), aspect());
    add_ball({on_screen(across, uniform(-1, 1), plate_depth()), kPlateHole});
  }
}

Place Composer::anywhere_on_screen(double nearest, double furthest) {
  const double across = uniform(-aspect(), aspect());
  const double upwards = uniform(-1, 1);
  const double depth = distance_to_body() * uniform(nearest, furthest);
  return {on_screen(across, upwards, depth), part_reach()};
}

Place Composer::anywhere_in_body() {
  const double x = uniform(-kBody, kBody);
  const double y = uniform(-kBody, kBody);
  const double z = uniform(-kBody, kBody);
  return {{x, y, z}, part_reach()};
}

Place Composer::anywhere_in(const Place& ball) {
  const double reach = part_reach();
  const double from_center = (ball.reach - 1.01 * reach) * std::cbrt(uniform(0, 1));
  return {ball.center + from_center * direction(), reach};
}

Composer::SurfacePoint Composer::anywhere_on_body() {
  constexpr double kWall = 4;  // its area over that of a cap
  const double angle = uniform(0, 2 * std::numbers::pi);
  const Vec3 outward{std::cos(angle), std::sin(angle), 0};
  if (uniform(0, kWall + 2) < kWall) {
    return {kBody * outward + Vec3{0, 0, uniform(-kBody, kBody)}, outward};
  }
  const double side = toss() ? -1 : 1;
  const double r = kBody * std::sqrt(uniform(0, 1));
  return {r * outward + Vec3{0, 0, side * kBody}, {0, 0, side}};
}

csgcore::Scene Composer::finish() {
  scene_.model = tree_.finish();
  return std::move(scene_);
}

}  // namespace frame_benchmark
