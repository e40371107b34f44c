// Finds the primitive that a pixel shows, and OpenSCAD's mesh of it.
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

  /// Returns the mesh of the primitive with that Primitive::id, in its local coordinates; null if
  /// the primitive is smooth, or unknown.
  const FacetMesh* mesh_of(uint32_t id) const {
    return id < meshes_.size() ? meshes_[id] : nullptr;
  }
  /// Precondition: mesh_of(id) is not null.
  const csgcore::Primitive& primitive(uint32_t id) const { return *primitives_[id]; }

 private:
  // By id:
  std::vector<const FacetMesh*> meshes_;
  std::vector<const csgcore::Primitive*> primitives_;
};

}  // namespace frontend
