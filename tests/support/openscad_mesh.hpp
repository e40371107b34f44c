// What OpenSCAD makes of a design: the judge of facets and of meshes.
#pragma once

#include <string>

#include "csgcore/facets.hpp"

namespace test_support {

bool openscad_installed();

/// The mesh that `openscad -o x.off` writes of a design, coordinates to six digits; empty for an
/// empty design. Throws std::runtime_error where OpenSCAD says nothing that can be read.
csgcore::Mesh openscad_mesh(const std::string& scad);
/// The same by `openscad -o x.stl`, coordinates to float's 24 bits: triangles, each with vertices
/// of its own.
csgcore::Mesh openscad_triangles(const std::string& scad);

/// Of a closed mesh, counterclockwise from outside.
double volume_of(const csgcore::Mesh& mesh);

}  // namespace test_support
