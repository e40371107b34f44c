// Round nodes: spheres, cylinders and circles.
#pragma once

#include "arguments/node_reader.hpp"
#include "csgcore/facets.hpp"
#include "csgcore/primitive.hpp"

namespace frontend {

/// A sphere, a cylinder, or a circle as its sphere, with no place, colour or id yet. Its shape need
/// not be valid (csgcore::has_valid_shape): it is empty then.
struct RoundNode {
  csgcore::Primitive primitive;
  csgcore::FacetSettings facets;
};

/// Missing arguments have OpenSCAD's defaults: r = 1, h = 1, center = false; a diameter goes before
/// its radius; names that OpenSCAD does not know are ignored, and `undef` counts as missing.
RoundNode read_sphere(NodeReader& reader);
RoundNode read_cylinder(NodeReader& reader);

}  // namespace frontend
