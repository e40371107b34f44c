// A scene in OpenSCAD's facets, and how far it may differ from the smooth one.
#pragma once

#include <vector>

#include "csgcore/scene.hpp"

namespace validation {

/// The scene with each round primitive as the polyhedron that OpenSCAD makes of it with so many
/// fragments (≥ 3), index for index. Equal ones share their polyhedron.
csgcore::Scene faceted(const csgcore::Scene& scene, int fragments);

/// Where a primitive and its facets may differ: within the smooth surface, and no deeper below it
/// than the facets' sagitta. In local coordinates, so that affine maps change nothing.
class SagittaShell {
 public:
  SagittaShell(const csgcore::Primitive& primitive, int fragments);

  /// False for what is a polyhedron anyway.
  bool contains(const csgcore::Vec3& point_world) const;
  /// From a point of the shell outwards to the smooth surface, in world units: no less than its
  /// distance from it.
  double depth(const csgcore::Vec3& point_world) const;

 private:
  /// The point's part that the facets cut short: all of it (sphere), or across the axis (frustum).
  struct Radial {
    csgcore::Vec3 part;
    double length;
    double surface;  // the length at which the smooth surface is
  };
  Radial radial(const csgcore::Vec3& point_local) const;
  csgcore::Vec3 to_local(const csgcore::Vec3& point_world) const;

  csgcore::Primitive primitive_;
  csgcore::Mat3 world_to_local_;
  double inner_ = 1;  // inscribed radius of the facets, as a share of the smooth radius
};

}  // namespace validation
