// OpenSCAD's builtin functions. What its documentation leaves open:
// - A wrong number of arguments (`f() number of parameters does not match`) is found before any is
//   evaluated.
// - Arguments that are not evaluated. log, min, max and rands stop at the first argument that is no
//   number. lookup evaluates a key that is no finite number twice, and then no table. search
//   evaluates four arguments, version_num one, version none; cross and ord none if there are too
//   many. chr and rands warn of an argument before they evaluate the next one.
// - Degrees. Angles are reduced by whole turns, then by symmetry to [0, 90], where 30, 45 and 60
//   are exact, and sin(180) is -0. From 2^52 turns on the result is NaN. tan counts half turns in
//   32 bits and loses its accuracy beyond 2^31 of them. asin, acos and atan return a whole angle
//   whose function is exactly the argument; atan2 rounds to whole angles within 3e-14.
// - min, max of one vector compare with `<`: what cannot be compared is not less.
// - rands draws from one mt19937 (19937 bits, 32 at a time) of the run. A seed is reduced modulo
//   2^31 - 1, a fraction by the inverse of 2. A value is (first + second · 2^32) / 2^64, scaled.
//   Equal bounds draw nothing.
// - search compares a code point with the first one of an entry's text as str() gives it, and bytes
//   that are no UTF-8 with each other as equal. Texts of 16 bytes and more are not found (OpenSCAD
//   has freed them by then, and finds one in some hundreds by chance). One entry without the column
//   ends the whole search with `[]`.
// - dxf_dim, dxf_cross evaluate their arguments in order, each with its warning; later ones win.
//   Circles have 36 fragments. dxf_cross looks at the first two chains that are single lines, a
//   point among them. What was found is kept under the path, the layer, the name, the numbers as
//   `%g` writes them, and the file's time and size; what was not found is looked for again.
//   "Illegal", "Not enough" are warnings at which --hardwarnings does not stop.
// - version_num of a vector of two with a non-number gives undef; OpenSCAD shows what it finds in
//   memory.
#pragma once

#include <span>
#include <string_view>

#include "functions/function_call.hpp"

namespace language {

/// All but those which the evaluator has to see through: is_undef, echo, assert, let. Sorted by
/// name.
std::span<const BuiltinFunction> builtin_functions();

/// Returns the function of that name, or null.
const BuiltinFunction* find_builtin_function(std::string_view name);

}  // namespace language
