// The primitives as solids with plane facets, for the Nef polyhedra.
#include "exact_twin.hpp"
#include "oracle/nef_solid.hpp"

namespace oracle {

FacetedSolid faceted(const csgcore::Primitive& primitive, int fragments) {
  return {twin_of(primitive.shape).half_spaces(primitive, fragments), primitive.local_to_world,
          primitive.mesh};
}

}  // namespace oracle
