// The exact shells of a triangle mesh.
#pragma once

#include <vector>

#include "nef_polytope.hpp"

namespace oracle {

/// A part of a mesh that is connected by edges, in world coordinates. The polytope faces outwards.
struct MeshShell {
  Polytope polytope;
  bool is_inward = false;  // whether the winding number is less within it than around it
};

/// Returns the shells of a solid that is a mesh. Throws std::invalid_argument if they are not
/// closed, intersect themselves, or have triangles without an area.
std::vector<MeshShell> shells_of(const FacetedSolid& solid);

/// Returns the planes of its triangles, except those without an area.
std::vector<Plane> triangle_planes(const FacetedSolid& solid);

}  // namespace oracle
