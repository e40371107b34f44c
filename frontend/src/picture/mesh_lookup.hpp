// Finds the primitive that a pixel shows, if OpenSCAD's edges of it are known.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/primitive.hpp"
#include "frontend/imported_design.hpp"

namespace frontend {

class MeshLookup {
 public:
  /// The design must outlive the lookup.
  explicit MeshLookup(const ImportedDesign& design);

  /// Returns the primitive with that Primitive::id; null if it is smooth, or unknown. It is a mesh,
  /// or a polyhedron with facets_of().
  const csgcore::Primitive* primitive_of(uint32_t id) const {
    return id < primitives_.size() ? primitives_[id] : nullptr;
  }
  /// Returns OpenSCAD's mesh of a polyhedron of primitive_of(), in its local coordinates.
  const FacetMesh& facets_of(const csgcore::Primitive& primitive) const {
    return facets_.at(primitive.polyhedron());
  }

 private:
  const FacetMeshes& facets_;
  std::vector<const csgcore::Primitive*> primitives_;  // by id
};

}  // namespace frontend
