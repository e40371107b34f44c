#include "base/primitive_traits.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

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

// Each kind's own file defines its traits.
#define FRONTEND_DECLARE(Name) extern const PrimitiveTraits& Name##_traits;
CSGCORE_FOR_EACH_SHAPE(FRONTEND_DECLARE)
#undef FRONTEND_DECLARE

const PrimitiveTraits& traits_of(csgcore::Shape shape) {
  switch (shape) {
#define FRONTEND_CASE(Name)     \
  case csgcore::Shape::k##Name: \
    return Name##_traits;
    CSGCORE_FOR_EACH_SHAPE(FRONTEND_CASE)
#undef FRONTEND_CASE
  }
  throw std::logic_error("a shape that is none");
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

std::shared_ptr<const csgcore::Polyhedron> PrimitiveTraits::faceted(const Primitive&, int) const {
  return nullptr;
}

RevolvedFaces PrimitiveTraits::revolved_faces(const Primitive&, int) const { return {}; }

Roundness PrimitiveTraits::roundness(const Primitive&) const { return {}; }

void PrimitiveTraits::find_plane_faces(const Primitive&, PlaneFaces&) const {}

double PrimitiveTraits::inscribed_share(int) const { return 1; }

std::optional<RadialPlace> PrimitiveTraits::radial_place(const Primitive&, const Vec3&) const {
  return std::nullopt;
}

LocalSolid local_solid(const Primitive& p) {
  return {p.shape, p.r_bottom, p.r_top, p.z_min, p.z_max, p.polyhedron.get(), p.mesh.get()};
}

}  // namespace frontend
