// Parts the faces of a solid where they only touch each other.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/triangle_set.hpp"

namespace csgcore {

/// Gives vertices at which several fans of triangles meet a copy for each of them, and edges with
/// four triangles and more one for each two that bound the same part of the solid: by copies of its
/// ends or, where these are connected elsewhere, by a vertex in its middle. Only edges and vertices
/// for which `may_touch` is set, by vertex, are looked at.
void part_touching_faces(BoundaryMesh& mesh, const std::vector<bool>& may_touch);

}  // namespace csgcore
