// The solid between the layers of an extrusion that is cut into slices.
#pragma once

#include <vector>

#include "csgcore/primitive.hpp"
#include "lower/slices.hpp"

namespace frontend {

/// Returns the closed mesh. Of the two diagonals of a quadrilateral of the sides it takes the one
/// that OpenSCAD takes. The polygons of the outline do not cross.
csgcore::Primitive sliced_mesh(const TwistedLayers& layers, const Slicing& slicing);

/// Returns the sides that a slice folds flat, each as two open meshes, its triangles: where a slice
/// turns by exactly half a turn, and both its ends are scaled alike, each side lies in one plane
/// and crosses itself, so that it encloses nothing, while OpenSCAD shows its two triangles.
std::vector<csgcore::Primitive> folded_sides(const TwistedLayers& layers, const Slicing& slicing);

/// Returns the box of the corners of all layers.
csgcore::Box sliced_box(const TwistedLayers& layers, int slices, const SimplePolygons& outline);

}  // namespace frontend
