// The boundary of a solid in triangles, for programs that trace triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "csgcore/scene.hpp"

namespace measure {

/// Of one primitive's facets, cut to what is left of them.
struct CutTriangle {
  std::array<csgcore::Vec3, 3> corners;  // counterclockwise from outside of the solid
  uint32_t primitive;
};

/// The boundary of a round primitive minus other round ones, each in OpenSCAD's facets (≥ 3): every
/// facet is cut along the planes of the primitives that it meets, and what remains is divided into
/// triangles. Neighbours need not share their vertices. Throws std::invalid_argument for another
/// tree or shape. Facets that coincide are not told apart: where there are any, it is no boundary.
std::vector<CutTriangle> cut_mesh(const csgcore::Scene& scene, int fragments);

}  // namespace measure
