// Arguments of the nodes that make geometry, as OpenSCAD binds them (frontend/OPENSCAD.md). An
// argument of the wrong type counts as missing, as in OpenSCAD, and is noted among the problems.
#pragma once

#include <optional>
#include <string>

#include "csgcore/facets.hpp"
#include "csgcore/primitive.hpp"
#include "frontend/design_tree.hpp"
#include "lower/node_problems.hpp"
#include "meshes/face_set.hpp"

namespace frontend {

/// Sphere, circle or cylinder node → primitive (a circle's is its sphere), with no place, colour or
/// id yet; it need not be valid (csgcore::is_valid). Missing arguments have OpenSCAD's defaults: r
/// = 1, h = 1, center = false; a diameter goes before its radius; names that OpenSCAD does not know
/// are ignored, and `undef` counts as missing.
struct RoundPrimitive {
  csgcore::Primitive primitive;
  csgcore::FacetSettings facets;
};
RoundPrimitive read_round_primitive(const NodeTree& tree, const Node& node, NodeProblems& problems);

/// Cube node → its box in local coordinates; it may be empty, flat or infinite. `size` is a number
/// or three, 1 where it is missing.
csgcore::Box read_cube(const NodeTree& tree, const Node& node, NodeProblems& problems);

/// Polyhedron node → its faces, which the file lists clockwise as seen from outside. `faces` goes
/// before `triangles`, its older name. A point without a z lies at 0. As in OpenSCAD 2021.01
/// (frontend/OPENSCAD.md, "Polyhedra"), an index beyond the points is left out, one that is no
/// number is 0, and a point that is none ends the faces where the first of them has it: what
/// follows is lost. All points that the faces have are finite.
FaceSet read_polyhedron(const NodeTree& tree, const Node& node, NodeProblems& problems);

/// Import or surface node. The file's name is as it stands in the file, empty if it is missing.
struct FileArguments {
  std::string file;
  bool is_centered = false, is_inverted = false;  // of a surface
};
FileArguments read_file_arguments(const NodeTree& tree, const Node& node, NodeProblems& problems);

/// The affine part of a multmatrix as it stands in the file, before the division by m[3][3].
struct FileMatrix {
  csgcore::Affine map;
  double divisor = 1;           // m[3][3]; may be 0
  bool has_all_digits = false;  // NodeTree::has_all_digits
};
/// Rows and entries that are missing are the identity's.
FileMatrix read_matrix(const NodeTree& tree, const Node& node, NodeProblems& problems);

/// The colour that a color node sets; none if it is invalid (in a .csg: -1,-1,-1,±1), which
/// for a name that is no colour is a problem. Channels above 1 count as 1.
std::optional<csgcore::Color> read_color(const NodeTree& tree, const Node& node,
                                         NodeProblems& problems);

}  // namespace frontend
