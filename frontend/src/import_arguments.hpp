// Arguments of the nodes that make geometry, as OpenSCAD binds them (openscad.md §1, §2).
#pragma once

#include <optional>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/primitive.hpp"
#include "frontend/error.hpp"
#include "frontend/syntax_tree.hpp"

namespace frontend {

/// Sphere or cylinder node → primitive, with no place, colour or id yet; it need not be valid
/// (csgcore::is_valid). Missing arguments have OpenSCAD's defaults: r = 1, h = 1, center = false;
/// a diameter goes before its radius; names that OpenSCAD does not know are ignored.
struct RoundPrimitive {
  csgcore::Primitive primitive;
  csgcore::FacetSettings facets;
};
/// Throws Error for an argument of the wrong type; `undef` counts as missing.
RoundPrimitive read_round_primitive(const SyntaxTree& tree, const SyntaxNode& node);

/// Cube node → its box in local coordinates; it may be empty, flat or infinite. `size` is a number
/// or three, 1 where it is missing. Throws Error for an argument of the wrong type.
csgcore::Box read_cube(const SyntaxTree& tree, const SyntaxNode& node);

/// Polyhedron node: its faces run clockwise seen from outside (csgcore::polyhedron_mesh). `faces`
/// goes before `triangles`, its older name. A point without a z lies at 0; an index that is no
/// index counts as one beyond the points. Throws Error for an argument of the wrong type.
struct PolyhedronArguments {
  std::vector<csgcore::Vec3> points;
  std::vector<std::vector<uint32_t>> faces;
};
PolyhedronArguments read_polyhedron(const SyntaxTree& tree, const SyntaxNode& node);

/// The affine part of a multmatrix as it stands in the file, before the division by m[3][3].
struct FileMatrix {
  csgcore::Affine map;
  double divisor = 1;  // m[3][3]; may be 0
};
/// Rows and entries that are missing are the identity's. Throws Error for entries that are no
/// numbers.
FileMatrix read_matrix(const SyntaxTree& tree, const SyntaxNode& node);

/// The colour that a color node sets; none if it is invalid (openscad.md §1: -1,-1,-1,±1), which
/// for a name that is no colour adds a warning. Channels above 1 count as 1. Throws Error for
/// arguments of the wrong type.
std::optional<csgcore::Color> read_color(const SyntaxTree& tree, const SyntaxNode& node,
                                         std::vector<Warning>& warnings);

/// "red", "#f00", "#ff0000" or "#ff0000ff", capitals or not, as OpenSCAD takes them.
std::optional<csgcore::Color> color_of_name(std::string_view name);

}  // namespace frontend
