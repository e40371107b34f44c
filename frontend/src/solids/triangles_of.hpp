// Primitives as triangles.
#pragma once

#include <vector>

#include "csgcore/boundary_mesh.hpp"
#include "csgcore/primitive.hpp"
#include "plane/figure.hpp"

namespace frontend {

/// Returns the closed boundary of the primitive under its matrix, with that many chords for a whole
/// circle. The shape is valid, and an extrusion's scale is not 0 at its bottom; a mesh is closed
/// only if it is closed itself.
csgcore::TriangleSet triangles_of(const csgcore::Primitive& primitive,
                                  int chords = kChordsOfCircle);

/// Puts a surface where the matrix puts it, facing outwards.
void place(csgcore::TriangleSet& surface, const csgcore::Affine& local_to_world);

/// Returns the hull of the points; no triangles if it has no volume. All coordinates are finite.
csgcore::TriangleSet triangles_of_hull(std::vector<csgcore::Vec3> points);

/// Takes z to 0 where it nearly is.
void put_in_plane(csgcore::TriangleSet& solid);
/// Returns whether z is 0 on OpenSCAD's grid, for a solid of that size.
bool is_in_plane(double z, double size);

}  // namespace frontend
