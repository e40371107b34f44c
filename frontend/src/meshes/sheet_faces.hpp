// Closed bodies without volume, of which OpenSCAD shows the faces.
#pragma once

#include <span>
#include <vector>

#include "csgcore/geometry.hpp"
#include "csgcore/triangle_mesh.hpp"

namespace frontend {

/// Returns one side of a closed body that encloses nothing, up to rounding: it lies in a plane, or
/// each of its triangles runs both ways. Empty for all other bodies.
std::vector<csgcore::TriangleMesh::Triangle> sheet_of(
    std::span<const csgcore::Vec3> points,
    std::span<const csgcore::TriangleMesh::Triangle> triangles);

}  // namespace frontend
