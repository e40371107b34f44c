// The boxes of leaves, as OpenSCAD finds them (frontend/OPENSCAD.md, "Camera").
#pragma once

#include "csgcore/facets.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"

namespace frontend {

/// The box of the corners of the (faceted) primitive's local box under its matrix, in world space.
csgcore::Box faceted_box(const csgcore::Primitive& primitive,
                         const csgcore::FacetSettings& settings);

/// Returns whether the map takes each coordinate axis along one of them, or to nothing.
bool is_axis_aligned(const csgcore::Affine& map);

/// The box of the corners of a box under a map.
csgcore::Box mapped(const csgcore::Affine& map, const csgcore::Box& box);

}  // namespace frontend
