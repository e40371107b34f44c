#include "picture/mesh_lookup.hpp"

namespace frontend {

MeshLookup::MeshLookup(const ImportedDesign& design) {
  if (design.meshes.empty()) return;
  meshes_.resize(design.primitive_nodes);
  primitives_.resize(design.primitive_nodes);
  for (const csgcore::Primitive& primitive : design.scene.primitives) {
    const auto found = design.meshes.find(primitive.polyhedron.get());
    if (found == design.meshes.end()) continue;
    meshes_.at(primitive.id) = &found->second;
    primitives_.at(primitive.id) = &primitive;
  }
}

}  // namespace frontend
