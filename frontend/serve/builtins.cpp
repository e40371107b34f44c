#include "builtins.hpp"

#include <algorithm>
#include <vector>

namespace serve {
namespace {

using language::LanguageVersion;

constexpr Builtin kBuiltins[] = {
    // Solids.
    {BuiltinKind::kModule, "cube", "cube(size = 1, center = false)",
     "A box. `size` is a number or [x, y, z]. It begins at the origin, or has it in its middle."},
    {BuiltinKind::kModule, "sphere", "sphere(r = 1)\nsphere(d)",
     "A ball around the origin, by its radius or its diameter."},
    {BuiltinKind::kModule, "cylinder",
     "cylinder(h = 1, r = 1, center = false)\ncylinder(h, r1, r2, center = false)\n"
     "cylinder(h, d, center = false)\ncylinder(h, d1, d2, center = false)",
     "A cylinder or a cone along z. `r1` and `d1` are at its foot. `center` moves its middle to z "
     "= "
     "0."},
    {BuiltinKind::kModule, "polyhedron", "polyhedron(points, faces, convexity = 1)",
     "A solid by its corners and its faces, lists of indices that run clockwise seen from "
     "outside."},
    {BuiltinKind::kModule, "import",
     "import(file, convexity = 1, layer = \"\", origin = [0, 0], scale = 1, center = false, dpi = "
     "96)",
     "A mesh (STL, OFF, AMF, 3MF) or a drawing (SVG, DXF). The file is looked for beside the "
     "design."},
    {BuiltinKind::kModule, "surface",
     "surface(file, center = false, convexity = 1, invert = false)",
     "A solid under a map of heights: numbers in rows, or the brightness of a PNG."},
    // Plane figures.
    {BuiltinKind::kModule, "circle", "circle(r = 1)\ncircle(d)", "A disc around the origin."},
    {BuiltinKind::kModule, "square", "square(size = 1, center = false)",
     "A rectangle. `size` is a number or [x, y]."},
    {BuiltinKind::kModule, "polygon", "polygon(points, paths, convexity = 1)",
     "A figure by its corners. `paths` are lists of their indices; several make holes."},
    {BuiltinKind::kModule, "text",
     "text(text, size = 10, font, halign = \"left\", valign = \"baseline\", spacing = 1, "
     "direction, "
     "language, script)",
     "Letters as a plane figure. `font` is a fontconfig pattern: \"Liberation Sans:style=Bold\"."},
    {BuiltinKind::kModule, "projection", "projection(cut = false) { … }",
     "The shadow of solids on the plane z = 0; with `cut`, their section by it."},
    // From the plane to solids.
    {BuiltinKind::kModule, "linear_extrude",
     "linear_extrude(height = 100, center = false, convexity = 1, twist = 0, slices, scale = 1) { "
     "… "
     "}",
     "A plane figure drawn up along z. `twist` is in degrees, `scale` a number or [x, y] at the "
     "top."},
    {BuiltinKind::kModule, "rotate_extrude", "rotate_extrude(angle = 360, convexity = 2) { … }",
     "A plane figure with x ≥ 0 turned about the z axis, `angle` degrees far."},
    // Operations.
    {BuiltinKind::kModule, "union", "union() { … }", "What lies in any child."},
    {BuiltinKind::kModule, "difference", "difference() { … }",
     "What lies in the first child and in none of the others."},
    {BuiltinKind::kModule, "intersection", "intersection() { … }", "What lies in all children."},
    {BuiltinKind::kModule, "hull", "hull() { … }", "The least convex body around all children."},
    {BuiltinKind::kModule, "minkowski", "minkowski(convexity = 1) { … }",
     "The Minkowski sum of the children: the first one with the others at each of its points."},
    {BuiltinKind::kModule, "offset", "offset(r)\noffset(delta, chamfer = false)",
     "A plane figure made wider, or with a negative number narrower: round by `r`, else with "
     "corners."},
    {BuiltinKind::kModule, "resize", "resize(newsize, auto = false, convexity = 1) { … }",
     "The children stretched to a size. 0 leaves a direction as it is; `auto` stretches it, too."},
    {BuiltinKind::kModule, "render", "render(convexity = 1) { … }",
     "The children, whose solid OpenSCAD computes even in a preview."},
    {BuiltinKind::kModule, "fill", "fill() { … }", "A plane figure without its holes.", true},
    {BuiltinKind::kModule, "roof", "roof(method = \"voronoi\", convexity = 1) { … }",
     "A roof over a plane figure. `method` is \"voronoi\" or \"straight\".", true},
    // Transformations.
    {BuiltinKind::kModule, "translate", "translate(v) { … }", "Moves the children by [x, y, z]."},
    {BuiltinKind::kModule, "rotate", "rotate(a, v) { … }",
     "Turns the children: by [x, y, z] degrees about the axes, x first; or by `a` degrees about "
     "`v`."},
    {BuiltinKind::kModule, "scale", "scale(v) { … }",
     "Stretches the children by a number or [x, y, z]."},
    {BuiltinKind::kModule, "mirror", "mirror(v) { … }",
     "Mirrors the children at the plane through the origin whose normal is `v`."},
    {BuiltinKind::kModule, "multmatrix", "multmatrix(m) { … }",
     "Moves the children by a matrix, 4 × 4 or 3 × 4."},
    {BuiltinKind::kModule, "color", "color(c, alpha = 1) { … }",
     "Colours the children: a CSS name, \"#rrggbb\", or [r, g, b, a] from 0 to 1."},
    // Structure.
    {BuiltinKind::kModule, "children", "children()\nchildren(index)",
     "The children of this module's call: all, one (from 0), or those of a vector or a range."},
    {BuiltinKind::kModule, "for", "for(variable = values) { … }",
     "The children once for each value of a range or a vector; over several variables, all pairs."},
    {BuiltinKind::kModule, "intersection_for", "intersection_for(variable = values) { … }",
     "The intersection of what the rounds of a loop make."},
    {BuiltinKind::kModule, "let", "let(variable = value) { … }",
     "Variables that its children see."},
    {BuiltinKind::kModule, "echo", "echo(value, …)", "Prints values to the console."},
    {BuiltinKind::kModule, "assert", "assert(condition, message)",
     "Ends the evaluation with an error if the condition is false."},
    {BuiltinKind::kModule, "group", "group() { … }", "Its children, together."},
    {BuiltinKind::kModule, "assign", "assign(variable = value) { … }",
     "The same as `let()`, by which it has been replaced.", false, true},
    {BuiltinKind::kModule, "child", "child(index = 0)",
     "The same as `children(index)`, which replaces it.", false, true},
    {BuiltinKind::kModule, "dxf_linear_extrude", "dxf_linear_extrude(file, layer, height)",
     "Use `linear_extrude()` of `import()`.", false, true},
    {BuiltinKind::kModule, "dxf_rotate_extrude", "dxf_rotate_extrude(file, layer)",
     "Use `rotate_extrude()` of `import()`.", false, true},
    {BuiltinKind::kModule, "import_dxf", "import_dxf(file)", "Use `import()`.", false, true},
    {BuiltinKind::kModule, "import_off", "import_off(file)", "Use `import()`.", false, true},
    {BuiltinKind::kModule, "import_stl", "import_stl(file)", "Use `import()`.", false, true},
    // Functions of numbers. Angles are in degrees.
    {BuiltinKind::kFunction, "abs", "abs(x)", "x without its sign."},
    {BuiltinKind::kFunction, "acos", "acos(x)", "The angle, in degrees, whose cosine is x."},
    {BuiltinKind::kFunction, "asin", "asin(x)", "The angle, in degrees, whose sine is x."},
    {BuiltinKind::kFunction, "atan", "atan(x)", "The angle, in degrees, whose tangent is x."},
    {BuiltinKind::kFunction, "atan2", "atan2(y, x)", "The angle, in degrees, of the point [x, y]."},
    {BuiltinKind::kFunction, "ceil", "ceil(x)", "The least whole number that is not below x."},
    {BuiltinKind::kFunction, "cos", "cos(degrees)", "The cosine of an angle."},
    {BuiltinKind::kFunction, "exp", "exp(x)", "e to the power of x."},
    {BuiltinKind::kFunction, "floor", "floor(x)", "The greatest whole number that is not above x."},
    {BuiltinKind::kFunction, "ln", "ln(x)", "The natural logarithm."},
    {BuiltinKind::kFunction, "log", "log(x)\nlog(base, x)",
     "The logarithm, to base 10 unless another is given."},
    {BuiltinKind::kFunction, "max", "max(a, b, …)\nmax(vector)", "The greatest number."},
    {BuiltinKind::kFunction, "min", "min(a, b, …)\nmin(vector)", "The least number."},
    {BuiltinKind::kFunction, "pow", "pow(base, exponent)", "A power; the same as base ^ exponent."},
    {BuiltinKind::kFunction, "rands", "rands(min, max, count, seed)",
     "A vector of random numbers, the same ones for the same seed."},
    {BuiltinKind::kFunction, "round", "round(x)",
     "The nearest whole number; halves away from zero."},
    {BuiltinKind::kFunction, "sign", "sign(x)", "-1, 0 or 1."},
    {BuiltinKind::kFunction, "sin", "sin(degrees)", "The sine of an angle."},
    {BuiltinKind::kFunction, "sqrt", "sqrt(x)", "The square root."},
    {BuiltinKind::kFunction, "tan", "tan(degrees)", "The tangent of an angle."},
    // Vectors and texts.
    {BuiltinKind::kFunction, "concat", "concat(a, b, …)", "One vector of the elements of several."},
    {BuiltinKind::kFunction, "cross", "cross(a, b)", "The cross product; of plane vectors, its z."},
    {BuiltinKind::kFunction, "len", "len(x)",
     "The number of elements of a vector, or of characters of a text."},
    {BuiltinKind::kFunction, "lookup", "lookup(key, table)",
     "A value between those of a table of [key, value], by straight lines."},
    {BuiltinKind::kFunction, "norm", "norm(vector)", "The length of a vector."},
    {BuiltinKind::kFunction, "search", "search(what, where, count = 1, column = 0)",
     "The indices at which elements or characters stand in a vector or a text."},
    {BuiltinKind::kFunction, "chr", "chr(code, …)",
     "The text of code points: numbers, vectors, ranges."},
    {BuiltinKind::kFunction, "ord", "ord(text)", "The code point of a text's first character."},
    {BuiltinKind::kFunction, "str", "str(value, …)", "The text of values, one after another."},
    // Types.
    {BuiltinKind::kFunction, "is_bool", "is_bool(x)", "Whether x is true or false."},
    {BuiltinKind::kFunction, "is_function", "is_function(x)", "Whether x is a function value."},
    {BuiltinKind::kFunction, "is_list", "is_list(x)", "Whether x is a vector."},
    {BuiltinKind::kFunction, "is_num", "is_num(x)", "Whether x is a number, and not NaN."},
    {BuiltinKind::kFunction, "is_string", "is_string(x)", "Whether x is a text."},
    {BuiltinKind::kFunction, "is_undef", "is_undef(x)",
     "Whether x is undef, or a name that is not known."},
    {BuiltinKind::kFunction, "is_object", "is_object(x)", "Whether x is an object.", true},
    {BuiltinKind::kFunction, "has_key", "has_key(object, name)", "Whether an object has a member.",
     true},
    {BuiltinKind::kFunction, "object", "object(name = value, …)\nobject(other, name = value, …)",
     "An object with these members.", true},
    // Files, fonts, the program.
    {BuiltinKind::kFunction, "dxf_cross", "dxf_cross(file, layer, origin, scale, name)",
     "The point at which two lines of a DXF's layer cross."},
    {BuiltinKind::kFunction, "dxf_dim", "dxf_dim(file, layer, origin, scale, name)",
     "The value of a dimension in a DXF."},
    {BuiltinKind::kFunction, "import", "import(file)", "The value in a JSON file.", true},
    {BuiltinKind::kFunction, "textmetrics",
     "textmetrics(text, size = 10, font, halign, valign, spacing, direction, language, script)",
     "Where text() draws: `position`, `size`, `ascent`, `descent`, `offset`, `advance`.", true},
    {BuiltinKind::kFunction, "fontmetrics", "fontmetrics(size = 10, font)",
     "The measures of a font: `nominal`, `max`, `interline`, `font`.", true},
    {BuiltinKind::kFunction, "parent_module", "parent_module(index = 1)",
     "The name of a module that the current one is called by."},
    {BuiltinKind::kFunction, "version", "version()", "OpenSCAD's version as [year, month]."},
    {BuiltinKind::kFunction, "version_num", "version_num()",
     "OpenSCAD's version as a number: 20210100."},
    // Variables.
    {BuiltinKind::kVariable, "PI", "3.14159", "A circle's length divided by its diameter."},
    {BuiltinKind::kVariable, "$fa", "12",
     "The least angle, in degrees, between the facets of something round."},
    {BuiltinKind::kVariable, "$fs", "2", "The least length of a facet of something round."},
    {BuiltinKind::kVariable, "$fn", "0",
     "The number of facets of something round; 0: $fa and $fs decide."},
    {BuiltinKind::kVariable, "$fe", "0",
     "The most distance between a facet and the round surface; 0: any.", true},
    {BuiltinKind::kVariable, "$t", "0", "The time of an animation, from 0 to below 1."},
    {BuiltinKind::kVariable, "$vpr", "[55, 0, 25]", "The camera's rotation in degrees."},
    {BuiltinKind::kVariable, "$vpt", "[0, 0, 0]", "The point at which the camera looks."},
    {BuiltinKind::kVariable, "$vpd", "140", "The camera's distance."},
    {BuiltinKind::kVariable, "$vpf", "22.5", "The camera's field of view in degrees."},
    {BuiltinKind::kVariable, "$children", "", "The number of children of this module's call."},
    {BuiltinKind::kVariable, "$parent_modules", "", "The number of modules around this one."},
    {BuiltinKind::kVariable, "$preview", "true",
     "Whether this is a preview, and not the final render."},
    // Words.
    {BuiltinKind::kWord, "module", "module name(parameters) { … }", "Defines a module."},
    {BuiltinKind::kWord, "function",
     "function name(parameters) = value;\nfunction(parameters) value",
     "Defines a function, or is one as a value."},
    {BuiltinKind::kWord, "if", "if (condition) … else …",
     "Makes its children, or an element of a vector, or not."},
    {BuiltinKind::kWord, "else", "if (condition) … else …",
     "What is made where the condition is false."},
    {BuiltinKind::kWord, "let", "let(variable = value) …", "Variables for what follows."},
    {BuiltinKind::kWord, "for", "for(variable = values) …",
     "Once for each value, in a vector or of children."},
    {BuiltinKind::kWord, "each", "each vector", "The elements of a vector, within another one."},
    {BuiltinKind::kWord, "assert", "assert(condition, message) …",
     "Ends the evaluation if it does not hold."},
    {BuiltinKind::kWord, "echo", "echo(value, …) …", "Prints values to the console."},
    {BuiltinKind::kWord, "true", "true", "The opposite of false."},
    {BuiltinKind::kWord, "false", "false", "0, \"\", [] and undef count as false, too."},
    {BuiltinKind::kWord, "undef", "undef", "No value."},
    {BuiltinKind::kWord, "include", "include <file.scad>", "Puts a file's text here."},
    {BuiltinKind::kWord, "use", "use <file.scad>", "Makes a file's modules and functions known."},
};

std::vector<Builtin> builtins_of_2021() {
  std::vector<Builtin> known(std::begin(kBuiltins), std::end(kBuiltins));
  std::erase_if(known, [](const Builtin& builtin) { return builtin.is_new; });
  return known;
}

}  // namespace

std::span<const Builtin> builtins(LanguageVersion version) {
  static const std::vector<Builtin> of_2021 = builtins_of_2021();
  if (version == LanguageVersion::k2026) return kBuiltins;
  return of_2021;
}

const Builtin* find_builtin(LanguageVersion version, BuiltinKind kind, std::string_view name) {
  const auto known = builtins(version);
  const auto found = std::ranges::find_if(
      known, [&](const Builtin& builtin) { return builtin.kind == kind && builtin.name == name; });
  return found == known.end() ? nullptr : &*found;
}

}  // namespace serve
