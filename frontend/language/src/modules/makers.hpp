// What makes the node of each builtin module (LANGUAGE.md, "Builtin modules").
#pragma once

#include "modules/builtin_call.hpp"

namespace language {

// Each is a BuiltinModule's make(). The first line of each group names the file.

// primitives.cpp; parameters: size, center
Made make_cube(const BuiltinCall& call, NodeTree& tree);
Made make_square(const BuiltinCall& call, NodeTree& tree);
// r, d
Made make_sphere(const BuiltinCall& call, NodeTree& tree);
Made make_circle(const BuiltinCall& call, NodeTree& tree);
// h, r1, r2, center, r, d, d1, d2
Made make_cylinder(const BuiltinCall& call, NodeTree& tree);

// point_lists.cpp; points, faces, convexity, triangles
Made make_polyhedron(const BuiltinCall& call, NodeTree& tree);
// points, paths, convexity
Made make_polygon(const BuiltinCall& call, NodeTree& tree);

// text_node.cpp; text, size, font, direction, language, script, halign, valign, spacing
Made make_text(const BuiltinCall& call, NodeTree& tree);

// transforms.cpp; v
Made make_translate(const BuiltinCall& call, NodeTree& tree);
Made make_scale(const BuiltinCall& call, NodeTree& tree);
Made make_mirror(const BuiltinCall& call, NodeTree& tree);
// a, v
Made make_rotate(const BuiltinCall& call, NodeTree& tree);
// m
Made make_multmatrix(const BuiltinCall& call, NodeTree& tree);

// color_node.cpp; c, alpha
Made make_color(const BuiltinCall& call, NodeTree& tree);

// extrusions.cpp; file, layer, height, origin, scale, center, twist, slices, convexity
Made make_linear_extrude(const BuiltinCall& call, NodeTree& tree);
bool wants_height(const BuiltinCall& call);
// file, layer, origin, scale, convexity, angle
Made make_rotate_extrude(const BuiltinCall& call, NodeTree& tree);

// operations.cpp; cut, convexity
Made make_projection(const BuiltinCall& call, NodeTree& tree);
// r, delta, chamfer
Made make_offset(const BuiltinCall& call, NodeTree& tree);
// none
Made make_hull(const BuiltinCall& call, NodeTree& tree);
// convexity
Made make_minkowski(const BuiltinCall& call, NodeTree& tree);
Made make_render(const BuiltinCall& call, NodeTree& tree);
// newsize, auto, convexity
Made make_resize(const BuiltinCall& call, NodeTree& tree);

// file_nodes.cpp; file, layer, convexity, origin, scale, width, height, filename, layername,
// center, dpi
Made make_import(const BuiltinCall& call, NodeTree& tree);
/// import_dxf(), import_off(), import_stl(): these write no SVG's arguments.
Made make_typed_import(const BuiltinCall& call, NodeTree& tree);
// file, center, convexity, invert
Made make_surface(const BuiltinCall& call, NodeTree& tree);

}  // namespace language
