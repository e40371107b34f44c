#include "faceted_scene.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <memory>

#include "base/primitive_traits.hpp"
#include "csgcore/polyhedron.hpp"

namespace validation {

using csgcore::Primitive;
using csgcore::Vec3;

namespace {

/// The shell is thicker by this share of the radius and of the height, since local coordinates are
/// rounded: far more than the rounding, far less than a sagitta.
constexpr double kShellSlack = 1e-9;

}  // namespace

std::optional<csgcore::Scene> faceted(const csgcore::Scene& scene, int fragments) {
  std::map<csgcore::LocalSolid, std::shared_ptr<const csgcore::Polyhedron>> shared;
  csgcore::Scene result = scene;
  for (Primitive& primitive : result.primitives) {
    if (primitive.mesh()) continue;
    auto& polyhedron = shared[primitive.solid];
    if (!polyhedron) {
      polyhedron = csgcore::faceted_polyhedron(primitive, fragments);
    }
    if (!polyhedron) return std::nullopt;
    Primitive replacement = csgcore::make_polyhedron(polyhedron, primitive.local_to_world);
    replacement.color = primitive.color;
    replacement.id = primitive.id;
    primitive = std::move(replacement);
  }
  return result;
}

SagittaShell::SagittaShell(const Primitive& primitive, int fragments)
    : primitive_(primitive),
      traits_(frontend::traits_of(primitive.shape())),
      world_to_local_(csgcore::inverse(primitive.local_to_world.linear)),
      inner_(traits_.inscribed_share(fragments)) {}

Vec3 SagittaShell::to_local(const Vec3& point_world) const {
  return world_to_local_ * (point_world - primitive_.local_to_world.translation);
}

bool SagittaShell::contains(const Vec3& point_world) const {
  const auto place = traits_.radial_place(primitive_, to_local(point_world));
  if (!place) return false;
  if (!(place->height >= -kShellSlack && place->height <= 1 + kShellSlack)) return false;
  const double length = glm::length(place->part), slack = kShellSlack * place->largest_surface;
  return length >= inner_ * place->surface - slack && length <= place->surface + slack;
}

double SagittaShell::depth(const Vec3& point_world) const {
  const auto place = traits_.radial_place(primitive_, to_local(point_world)).value();
  const double length = glm::length(place.part);
  if (length == 0) return 0;  // at an apex
  return glm::length(primitive_.local_to_world.linear * place.part) *
         std::abs(place.surface / length - 1);
}

}  // namespace validation
