// The boundary of a solid in triangles, for programs that trace triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "csgcore/scene.hpp"

namespace measure {

/// A triangle of what remains of one primitive's facet.
struct CutTriangle {
  std::array<csgcore::Vec3, 3> corners;  // counterclockwise from outside of the solid
  uint32_t primitive;
};

/// Returns the boundary of a round primitive minus other round ones, each in OpenSCAD's facets (≥
/// 3). Every facet is cut along the planes of the primitives that it meets, and the rest is divided
/// into triangles. Neighbours need not share their vertices. Throws std::invalid_argument for
/// another tree or shape. Precondition: no facets coincide, since they are not told apart.
std::vector<CutTriangle> cut_mesh(const csgcore::Scene& scene, int fragments);

}  // namespace measure
