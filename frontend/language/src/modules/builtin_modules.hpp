// OpenSCAD's builtin modules, from their arguments to nodes (LANGUAGE.md, "Builtin modules").
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/dialect.hpp"
#include "files/named_files.hpp"
#include "language/node_tree.hpp"
#include "language/source_files.hpp"
#include "language/value.hpp"
#include "messages/messages.hpp"

namespace language {

/// What builtin modules use besides their arguments; one per evaluation.
struct ModuleEnvironment {
  const Dialect& dialect;
  Messages& messages;
  NamedFiles& files;
  bool checks_ranges = false;  // --check-parameter-ranges
};

/// A call whose arguments are resolved and evaluated.
struct BuiltinCall {
  /// By declared parameter, positional ones first, in BuiltinModule's order. Unset: not given.
  std::span<const Value> parameters;
  /// The first argument, evaluated once more; unset unless BuiltinModule::wants_first asked for it.
  Value first;
  /// $fn, $fa and $fs as the call sees them.
  Value fragments_number, fragments_angle, fragments_size, fragments_error;
  Place place;  // of the call
  ModuleEnvironment& environment;
};

/// What becomes of the call's children.
enum class ChildRule : uint8_t {
  kTakes,    // they become the node's children
  kRefuses,  // "module ‹n›() does not support child modules", not evaluated
  kIgnores,  // silently not evaluated
};

/// What has become of a call.
enum class Made : uint8_t {
  kNothing,  // there is to be no node
  kLeaf,     // a node whose children are not evaluated
  kNode,     // a node that takes children, if its rule says so
};

struct BuiltinModule {
  std::string_view name;
  std::span<const std::string_view> positional;  // declared parameters, in order
  std::span<const std::string_view> named_only;
  ChildRule children;
  /// Fills in the kind and the arguments of the tree's last node, and says what is wrong with them.
  Made (*make)(const BuiltinCall& call, NodeTree& tree);
  /// What to use instead of a deprecated module: "linear_extrude()"; empty if it is not deprecated.
  /// Said before the arguments are evaluated.
  std::string_view successor{};
  /// If not null: called before make() if the call's first argument has no name. True asks for that
  /// argument to be evaluated once more, after the others.
  bool (*wants_first)(const BuiltinCall& call) = nullptr;
};

/// All whose arguments are resolved by the rules of user modules. Left to the evaluator: for,
/// intersection_for, let, assign, if, echo, assert, children, child, each, group, union,
/// difference, intersection. Sorted by name. Those of 2026 have other rows where parameters, or
/// what is made of them, differ.
std::span<const BuiltinModule> builtin_modules(LanguageVersion version);

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

// The same in 2026. points, faces, convexity, triangles; points, paths, convexity
Made make_polyhedron_2026(const BuiltinCall& call, NodeTree& tree);
Made make_polygon_2026(const BuiltinCall& call, NodeTree& tree);
// text, size, font, direction, language, script, halign, valign, spacing
Made make_text_2026(const BuiltinCall& call, NodeTree& tree);
// height, v, scale, center, twist, slices, segments, convexity, h
Made make_linear_extrude_2026(const BuiltinCall& call, NodeTree& tree);
// angle, start, convexity, a
Made make_rotate_extrude_2026(const BuiltinCall& call, NodeTree& tree);
// those of import(), id
Made make_import_2026(const BuiltinCall& call, NodeTree& tree);
// none
Made make_fill(const BuiltinCall& call, NodeTree& tree);
// method, convexity
Made make_roof(const BuiltinCall& call, NodeTree& tree);

}  // namespace language
