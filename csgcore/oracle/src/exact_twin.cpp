#include "exact_twin.hpp"

#include <stdexcept>

#include "csgcore/polyhedron.hpp"
#include "oracle/nef_solid.hpp"

namespace oracle {

// The file of each kind defines its twin.
#define ORACLE_DECLARE(Name) extern const ExactTwin& Name##_twin;
CSGCORE_FOR_EACH_SHAPE(ORACLE_DECLARE)
#undef ORACLE_DECLARE

const ExactTwin& twin_of(csgcore::Shape shape) {
  switch (shape) {
#define ORACLE_CASE(Name)       \
  case csgcore::Shape::k##Name: \
    return Name##_twin;
    CSGCORE_FOR_EACH_SHAPE(ORACLE_CASE)
#undef ORACLE_CASE
  }
  throw std::logic_error("a shape that is none");
}

std::vector<double*> ExactTwin::sizes(csgcore::Primitive&) const { return {}; }

std::vector<csgcore::Primitive> ExactTwin::simpler(const csgcore::Primitive& primitive) const {
  return {csgcore::make_sphere(1, primitive.local_to_world)};
}

FacetedSolid faceted(const csgcore::Primitive& primitive, int fragments) {
  const auto* const mesh = std::get_if<csgcore::MeshShape>(&primitive.solid);
  const auto polyhedron = csgcore::faceted_polyhedron(primitive, fragments);
  return {polyhedron ? polyhedron->half_spaces() : std::vector<csgcore::HalfSpace>{},
          primitive.local_to_world, mesh ? mesh->mesh : nullptr};
}

Walls<Exact> ExactTwin::walls(const Target<Exact>&, const Vector<Exact>&,
                              const Vector<Exact>&) const {
  return {};
}

Walls<Interval> ExactTwin::walls(const Target<Interval>&, const Vector<Interval>&,
                                 const Vector<Interval>&) const {
  return {};
}

Vector<Interval> ExactTwin::wall_normal(const Target<Interval>&, const Vector<Interval>&) const {
  return {};
}

}  // namespace oracle
