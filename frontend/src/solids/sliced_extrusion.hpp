// The solid of a linear_extrude that is cut into slices.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "arguments/node_data.hpp"
#include "csgcore/primitive.hpp"
#include "solids/sliced_solid.hpp"

namespace frontend {

TwistedLayers layers_of(const LinearExtrudeArguments& arguments);

/// Returns the map that lets the layers lean: it leaves z = 0 as it is.
csgcore::Affine leaning(const LinearExtrudeArguments& arguments);

struct SlicedExtrusion {
  csgcore::Primitive mesh;
  std::vector<csgcore::Primitive> sheets;  // folded_sides()
  csgcore::Box box;                        // of OpenSCAD's corners
};

/// Returns the solid of the figures, whose layers turn or are scaled differently in x and y, before
/// they lean. Nothing if it is empty, or left out, of which `problems` is told.
std::optional<SlicedExtrusion> sliced_extrusion(const LinearExtrudeNode& data, const Node& node,
                                                std::span<const Figure> figures,
                                                NodeProblems& problems);

}  // namespace frontend
