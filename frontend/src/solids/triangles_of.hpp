// Primitives as triangles.
#pragma once

#include "csgcore/primitive.hpp"
#include "plane/flattened_solid.hpp"

namespace frontend {

/// Returns the closed boundary of the primitive under its matrix, whose vertices' z it takes to
/// OpenSCAD's grid where they nearly are 0. What is round has facets that no picture shows. The
/// shape is valid, and an extrusion's scale is not 0 at its bottom; a mesh is closed only if it is
/// closed itself.
TriangleSet triangles_of(const csgcore::Primitive& primitive);

/// Returns whether z is 0 on OpenSCAD's grid, for a solid of that size.
bool is_in_plane(double z, double size);

}  // namespace frontend
