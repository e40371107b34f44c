#include "base/primitive_traits.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace frontend
