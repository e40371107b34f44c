#include "picture/mesh_lookup.hpp"

namespace frontend {

MeshLookup::MeshLookup(const ImportedDesign& design) : facets_(design.meshes) {
  for (const csgcore::Primitive& primitive : design.scene.primitives) {
    if (!primitive.mesh() && !facets_.contains(primitive.polyhedron())) continue;
    if (primitives_.empty()) primitives_.resize(design.primitive_nodes);
    primitives_.at(primitive.id) = &primitive;
  }
}

}  // namespace frontend
