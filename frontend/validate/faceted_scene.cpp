#include "faceted_scene.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <tuple>

#include "csgcore/facets.hpp"
#include "csgcore/polyhedron.hpp"

namespace validation {

using csgcore::Primitive;
using csgcore::Shape;
using csgcore::Vec3;

namespace {

/// Local coordinates are rounded; the shell is so much thicker, as a share of the radius: far more
/// than rounding, far less than a sagitta.
constexpr double kShellSlack = 1e-9;

}  // namespace

csgcore::Scene faceted(const csgcore::Scene& scene, int fragments) {
  using Sizes = std::tuple<Shape, double, double, double, double>;
  std::map<Sizes, std::shared_ptr<const csgcore::Polyhedron>> shared;
  csgcore::Scene result = scene;
  for (Primitive& primitive : result.primitives) {
    if (primitive.shape == Shape::kPolyhedron) continue;
    auto& polyhedron = shared[{primitive.shape, primitive.r_bottom, primitive.r_top,
                               primitive.z_min, primitive.z_max}];
    if (!polyhedron) polyhedron = csgcore::Polyhedron::faceted(primitive, fragments);
    Primitive replacement = csgcore::make_polyhedron(polyhedron, primitive.local_to_world);
    replacement.color = primitive.color;
    replacement.id = primitive.id;
    primitive = std::move(replacement);
  }
  return result;
}

SagittaShell::SagittaShell(const Primitive& primitive, int fragments)
    : primitive_(primitive), world_to_local_(csgcore::inverse(primitive.local_to_world.linear)) {
  // The middle of a chord between two neighbouring vertices of a circle. A sphere's facets are
  // chords of its rings and of its meridians, along which rings are 180°/rings apart.
  inner_ = std::cos(std::numbers::pi / fragments);
  if (primitive.shape == Shape::kSphere) {
    inner_ *= std::cos(std::numbers::pi / (2 * csgcore::ring_count(fragments)));
  }
}

Vec3 SagittaShell::to_local(const Vec3& point_world) const {
  return world_to_local_ * (point_world - primitive_.local_to_world.translation);
}

SagittaShell::Radial SagittaShell::radial(const Vec3& point_local) const {
  if (primitive_.shape == Shape::kSphere) {
    return {point_local, glm::length(point_local), primitive_.r_bottom};
  }
  const Vec3 part(point_local.x, point_local.y, 0);
  const double t = (point_local.z - primitive_.z_min) / (primitive_.z_max - primitive_.z_min);
  return {part, glm::length(part),
          primitive_.r_bottom + t * (primitive_.r_top - primitive_.r_bottom)};
}

bool SagittaShell::contains(const Vec3& point_world) const {
  if (primitive_.shape == Shape::kPolyhedron) return false;
  const Vec3 point = to_local(point_world);
  const auto [part, length, surface] = radial(point);
  if (primitive_.shape == Shape::kFrustum) {
    const double slack = kShellSlack * (primitive_.z_max - primitive_.z_min);
    if (!(point.z >= primitive_.z_min - slack && point.z <= primitive_.z_max + slack)) return false;
  }
  const double slack = kShellSlack * std::max(primitive_.r_bottom, primitive_.r_top);
  return length >= inner_ * surface - slack && length <= surface + slack;
}

double SagittaShell::depth(const Vec3& point_world) const {
  const auto [part, length, surface] = radial(to_local(point_world));
  if (length == 0) return 0;  // an apex
  return glm::length(primitive_.local_to_world.linear * part) * std::abs(surface / length - 1);
}

}  // namespace validation
