#include "base/primitive_traits.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/angles.hpp"
#include "csgcore/canonical_primitive.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Primitive;
using csgcore::Vec3;

Primitive without_map(Primitive primitive) {
  primitive.local_to_world = {};
  return primitive;
}

Box smooth_box(const Primitive& primitive) {
  return csgcore::canonicalize(without_map(primitive)).bounds;
}

double cos_of_turn(double part) { return std::cos(kTurn * part); }

/// Only the vertices nearest to the four half-axes matter.
Box box_of_polygon(int fragments) {
  const double n = fragments;
  // Returns the largest coordinate along the axis that lies `turn` of a full turn away from vertex
  // 0.
  const auto reach = [&](double turn) { return cos_of_turn(std::round(turn * n) / n - turn); };
  Box box;
  box.min = Vec3(-reach(0.5), -reach(0.75), 0);
  box.max = Vec3(1, reach(0.25), 0);
  return box;
}

}  // namespace

// Each of these kinds defines its traits in a file of its own.
extern const PrimitiveTraits &Sphere_traits, &Frustum_traits, &Polyhedron_traits, &Mesh_traits;

const PrimitiveTraits& traits_of(csgcore::Shape shape) {
  static constexpr PrimitiveTraits kDefaults;
  switch (shape) {
    case csgcore::Shape::kSphere:
      return Sphere_traits;
    case csgcore::Shape::kFrustum:
      return Frustum_traits;
    case csgcore::Shape::kPolyhedron:
      return Polyhedron_traits;
    case csgcore::Shape::kMesh:
      return Mesh_traits;
    default:
      return kDefaults;
  }
}

double PrimitiveTraits::extent(const Primitive& primitive) const {
  const Box box = smooth_box(primitive);
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) {
    extent = std::max({extent, std::abs(box.min[axis]), std::abs(box.max[axis])});
  }
  return extent;
}

int PrimitiveTraits::fragments(const Primitive&, const csgcore::FacetSettings&) const { return 0; }

Box PrimitiveTraits::faceted_box(const Primitive& primitive, const csgcore::FacetSettings&) const {
  return smooth_box(primitive);
}

Faceting PrimitiveTraits::faceting(const Primitive& primitive, int fragments) const {
  const auto around = static_cast<uint64_t>(fragments);
  return {without_map(primitive), Vec3(0.0), Vec3(1.0), around * around};
}

RevolvedFaces PrimitiveTraits::revolved_faces(const Primitive&, int) const { return {}; }

Roundness PrimitiveTraits::roundness(const Primitive&) const { return {}; }

void PrimitiveTraits::find_plane_faces(const Primitive&, PlaneFaces&) const {}

double PrimitiveTraits::inscribed_share(int) const { return 1; }

std::optional<RadialPlace> PrimitiveTraits::radial_place(const Primitive&, const Vec3&) const {
  return std::nullopt;
}

bool parallel(const csgcore::Vec3& unit_a, const csgcore::Vec3& unit_b) {
  return glm::length(glm::cross(unit_a, unit_b)) <= kParallel;
}

double size_of(const csgcore::Primitive& primitive) {
  double stretch = 0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      stretch = std::max(stretch, std::abs(primitive.local_to_world.linear[column][row]));
    }
  }
  return traits_of(primitive.shape()).extent(primitive) * stretch;
}

const Box& unit_polygon_box(int fragments) {
  // A file has few numbers of fragments, mostly in a row.
  struct Last {
    int fragments = 0;
    Box box;
  };
  thread_local Last last;
  if (last.fragments != fragments) last = {fragments, box_of_polygon(fragments)};
  return last.box;
}

}  // namespace frontend
