// What makes the node of each builtin module (LANGUAGE.md, "Builtin modules").
#pragma once

#include "modules/builtin_call.hpp"

namespace language {

// Each is a BuiltinModule's make(). The first line of each group names the file.

// primitives.cpp; parameters: size, center
Made make_cube(const BuiltinCall& call, Node& node);
Made make_square(const BuiltinCall& call, Node& node);
// r, d
Made make_sphere(const BuiltinCall& call, Node& node);
Made make_circle(const BuiltinCall& call, Node& node);
// h, r1, r2, center, r, d, d1, d2
Made make_cylinder(const BuiltinCall& call, Node& node);

// point_lists.cpp; points, faces, convexity, triangles
Made make_polyhedron(const BuiltinCall& call, Node& node);
// points, paths, convexity
Made make_polygon(const BuiltinCall& call, Node& node);

// text_node.cpp; text, size, font, direction, language, script, halign, valign, spacing
Made make_text(const BuiltinCall& call, Node& node);

// transforms.cpp; v
Made make_translate(const BuiltinCall& call, Node& node);
Made make_scale(const BuiltinCall& call, Node& node);
Made make_mirror(const BuiltinCall& call, Node& node);
// a, v
Made make_rotate(const BuiltinCall& call, Node& node);
// m
Made make_multmatrix(const BuiltinCall& call, Node& node);

// color_node.cpp; c, alpha
Made make_color(const BuiltinCall& call, Node& node);

// extrusions.cpp; file, layer, height, origin, scale, center, twist, slices, convexity
Made make_linear_extrude(const BuiltinCall& call, Node& node);
bool wants_height(const BuiltinCall& call);
// file, layer, origin, scale, convexity, angle
Made make_rotate_extrude(const BuiltinCall& call, Node& node);

// operations.cpp; cut, convexity
Made make_projection(const BuiltinCall& call, Node& node);
// r, delta, chamfer
Made make_offset(const BuiltinCall& call, Node& node);
// none
Made make_hull(const BuiltinCall& call, Node& node);
// convexity
Made make_minkowski(const BuiltinCall& call, Node& node);
Made make_render(const BuiltinCall& call, Node& node);
// newsize, auto, convexity
Made make_resize(const BuiltinCall& call, Node& node);

// file_nodes.cpp; file, layer, convexity, origin, scale, width, height, filename, layername,
// center, dpi
Made make_import(const BuiltinCall& call, Node& node);
Made make_deprecated_import(const BuiltinCall& call, Node& node);  // import_stl() and others
// file, center, convexity, invert
Made make_surface(const BuiltinCall& call, Node& node);

}  // namespace language
