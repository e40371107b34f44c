// What OpenSCAD's --viewall looks at (frontend/OPENSCAD.md, "Camera").
#pragma once

#include <span>

#include "csgcore/csg_tree.hpp"
#include "csgcore/facets.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"

namespace frontend {

/// The box of the corners of the (faceted) primitive's local box under its matrix, in world space.
csgcore::Box faceted_box(const csgcore::Primitive& primitive,
                         const csgcore::FacetSettings& settings);

/// The union of the boxes of the leaves that OpenSCAD draws positively when it has written the tree
/// as a union of products: a leaf under an even number of subtractions, unless the operands that it
/// stands with have boxes apart from its own. `boxes` holds the primitives' boxes.
csgcore::Box view_box(const csgcore::CsgTree& tree, std::span<const csgcore::Box> boxes);

}  // namespace frontend
