// A scene in OpenSCAD's facets, and how far it may differ from the smooth one.
#pragma once

#include <optional>

#include "csgcore/scene.hpp"

namespace frontend {
class PrimitiveTraits;
}

namespace validation {

/// The scene with each primitive as the convex polyhedron that OpenSCAD makes of it with so many
/// fragments (≥ 3), index for index. Equal ones share their polyhedron. Nothing if there is no such
/// polyhedron for one of them.
std::optional<csgcore::Scene> faceted(const csgcore::Scene& scene, int fragments);

/// Where a primitive and its facets may differ: within the smooth surface, and no deeper below it
/// than the facets' sagitta. In local coordinates, so that affine maps change nothing.
class SagittaShell {
 public:
  SagittaShell(const csgcore::Primitive& primitive, int fragments);

  /// False for what is a polyhedron anyway.
  bool contains(const csgcore::Vec3& point_world) const;
  /// From a point of the shell outwards to the smooth surface, in world units: no less than its
  /// distance from it. The primitive must not be a polyhedron.
  double depth(const csgcore::Vec3& point_world) const;

 private:
  csgcore::Vec3 to_local(const csgcore::Vec3& point_world) const;

  csgcore::Primitive primitive_;
  const frontend::PrimitiveTraits& traits_;
  csgcore::Mat3 world_to_local_;
  double inner_;  // inscribed radius of the facets, as a share of the smooth radius
};

}  // namespace validation
