// A scene in OpenSCAD's facets, and how far it may differ from the smooth scene.
#pragma once

#include <optional>

#include "csgcore/scene.hpp"

namespace frontend {
class PrimitiveTraits;
}

namespace validation {

/// Returns the scene with each primitive replaced, at the same index, by the convex polyhedron that
/// OpenSCAD makes of it with `fragments` (≥ 3) fragments. Equal primitives share a polyhedron.
/// Meshes stay as they are. Nothing if another primitive has no such polyhedron.
std::optional<csgcore::Scene> faceted(const csgcore::Scene& scene, int fragments);

/// The region in which a primitive and its facets may differ: inside the smooth surface, and no
/// deeper below it than the facets' sagitta. It is defined in local coordinates, so that affine
/// maps do not change it.
class SagittaShell {
 public:
  SagittaShell(const csgcore::Primitive& primitive, int fragments);

  /// Returns false for a polyhedron or a mesh, which facets do not change.
  bool contains(const csgcore::Vec3& point_world) const;
  /// Returns the way from a point of the shell outwards to the smooth surface, in world units,
  /// which is no less than its distance. Precondition: the primitive is not a polyhedron.
  double depth(const csgcore::Vec3& point_world) const;

 private:
  csgcore::Vec3 to_local(const csgcore::Vec3& point_world) const;

  csgcore::Primitive primitive_;
  const frontend::PrimitiveTraits& traits_;
  csgcore::Mat3 world_to_local_;
  double inner_;  // inscribed radius of the facets, as a share of the smooth radius
};

}  // namespace validation
