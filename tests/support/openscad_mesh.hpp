// Meshes that OpenSCAD makes of a design: the judge of facets and of meshes.
#pragma once

#include <string>

#include "csgcore/facets.hpp"

namespace test_support {

bool openscad_installed();

/// Returns the mesh that `openscad -o x.off` writes of a design, with coordinates of six digits;
/// empty for an empty design. Throws std::runtime_error if OpenSCAD writes nothing that can be
/// read.
csgcore::Mesh openscad_mesh(const std::string& scad);
/// Returns the mesh of `openscad -o x.stl`, with coordinates of float's 24 bits: triangles, each
/// with vertices of its own.
csgcore::Mesh openscad_triangles(const std::string& scad);

/// Returns the volume of a closed mesh whose faces are counterclockwise seen from outside.
double volume_of(const csgcore::Mesh& mesh);

}  // namespace test_support
