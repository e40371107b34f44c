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

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/dialect.hpp"
#include "files/named_files.hpp"
#include "language/source_files.hpp"
#include "language/text_meter.hpp"
#include "language/value.hpp"
#include "messages/messages.hpp"

namespace language {

/// What builtin functions use besides their arguments; one per evaluation.
struct FunctionEnvironment {
  const Dialect& dialect;
  Messages& messages;
  NamedFiles& files;
  std::mt19937 random;  // of rands(), seeded by time and process unless a call seeds it
  /// Names of the user modules on the stack, outermost first: parent_module() reads them.
  std::vector<std::string_view> module_names{};
  /// What dxf_dim() and dxf_cross() have found.
  std::unordered_map<std::string, Value> measures{};
  /// What textmetrics() and fontmetrics() ask; null: there are no fonts.
  TextMeter* text_meter = nullptr;
  std::vector<std::string> fonts{};  // files that the design brings along
};

struct FunctionCall {
  std::string_view name;  // of the function
  size_t written;         // arguments that the call has
  /// The arguments that have been evaluated, in that order. A call may move them away.
  std::span<Value> arguments;
  Place place;  // of the call
  FunctionEnvironment& environment;
  /// Of the written arguments; empty: it has none. Only of functions with next_argument(); others
  /// ignore names.
  std::span<const std::string_view> names{};

  /// Says a warning at the call.
  void warn(std::string text) const { environment.messages.warn(std::move(text), place); }
};

constexpr uint16_t kAnyCount = 0xFFFF;
constexpr size_t kNoArgument = SIZE_MAX;

/// How many arguments a function takes.
struct Arity {
  uint16_t least = 0, most = 0;
  std::string_view words{};  // "3 or 4", where it is not `least` that is said to be expected
};

struct BuiltinFunction {
  std::string_view name;
  uint16_t least_arguments;  // fewer or more: "‹f›() number of parameters does not match", undef
  uint16_t most_arguments;
  Value (*call)(const FunctionCall& call);
  /// A function that does not evaluate all its arguments has this: it returns which of the written
  /// arguments is evaluated next, given those that have been, or kNoArgument. Each value is added
  /// to the call's arguments, also where an argument is evaluated for a second time. Null: all are
  /// evaluated, in the order in which they are written.
  size_t (*next_argument)(const FunctionCall& call) = nullptr;
  Arity arity_of_2026{};         // where it is another one, or has words
  bool reads_names = false;      // of its arguments
  bool is_experimental = false;  // only where there are objects
  /// If the function is called like a module in 2026, arguments are assigned to these by their
  /// names and positions, and what is not given is unset. Empty: names are ignored.
  std::span<const std::string_view> parameters{};
};

/// Returns how many arguments a function takes in a dialect.
Arity arity_of(const BuiltinFunction& function, const Dialect& dialect);
/// Returns what is said of a call with a wrong number of arguments.
std::string wrong_count(const BuiltinFunction& function, size_t found, const Dialect& dialect);

/// All but those which the evaluator has to see through: is_undef, echo, assert, let. Sorted by
/// name.
std::span<const BuiltinFunction> builtin_functions();

}  // namespace language

namespace language::functions {

/// The parameters of dxf_dim() and dxf_cross().
inline constexpr std::string_view kDrawingParameters[] = {"file", "layer", "origin", "scale",
                                                          "name"};

// numbers.cpp
Value absolute(const FunctionCall& call);
Value sign(const FunctionCall& call);
Value floor(const FunctionCall& call);
Value ceiling(const FunctionCall& call);
Value round(const FunctionCall& call);
Value square_root(const FunctionCall& call);
Value exponential(const FunctionCall& call);
Value natural_logarithm(const FunctionCall& call);
Value sine(const FunctionCall& call);
Value cosine(const FunctionCall& call);
Value tangent(const FunctionCall& call);
Value arc_sine(const FunctionCall& call);
Value arc_cosine(const FunctionCall& call);
Value arc_tangent(const FunctionCall& call);
Value arc_tangent_of_two(const FunctionCall& call);
Value power(const FunctionCall& call);
Value logarithm(const FunctionCall& call);
Value minimum(const FunctionCall& call);
Value maximum(const FunctionCall& call);

// vectors.cpp
Value norm(const FunctionCall& call);
Value cross(const FunctionCall& call);
Value length(const FunctionCall& call);
Value concatenation(const FunctionCall& call);

// texts.cpp
Value string(const FunctionCall& call);
Value characters(const FunctionCall& call);
Value code_point(const FunctionCall& call);

// lookup.cpp, search.cpp, rands.cpp
Value lookup(const FunctionCall& call);
Value search(const FunctionCall& call);
Value random_numbers(const FunctionCall& call);

// objects.cpp
Value object(const FunctionCall& call);
Value has_key(const FunctionCall& call);
Value is_object(const FunctionCall& call);

// json.cpp
Value imported_json(const FunctionCall& call);

// metrics.cpp
Value text_metrics(const FunctionCall& call);
Value font_metrics(const FunctionCall& call);

// drawings.cpp
Value drawing_dimension(const FunctionCall& call);
Value drawing_cross(const FunctionCall& call);

// facts.cpp
Value version(const FunctionCall& call);
Value version_number(const FunctionCall& call);
Value is_list(const FunctionCall& call);
Value is_number(const FunctionCall& call);
Value is_bool(const FunctionCall& call);
Value is_string(const FunctionCall& call);
Value is_function(const FunctionCall& call);
Value parent_module(const FunctionCall& call);

/// The rules by which arguments are evaluated: until one is no number; none; the first alone;
/// the first four; all if there are as many as the function takes, else none; lookup()'s key, which
/// is evaluated twice if it is no finite number, and then its table if it is.
size_t next_while_numbers(const FunctionCall& call);
size_t next_of_none(const FunctionCall& call);
size_t next_of_one(const FunctionCall& call);
size_t next_of_four(const FunctionCall& call);
size_t next_of_exactly_one(const FunctionCall& call);
size_t next_of_exactly_two(const FunctionCall& call);
size_t next_of_lookup(const FunctionCall& call);

/// object() stops at the first argument that says no members.
size_t next_of_object(const FunctionCall& call);
/// The same of chr(), rands(), dxf_dim() and dxf_cross(), which warn of an argument before the next
/// one is evaluated.
size_t next_of_characters(const FunctionCall& call);
size_t next_of_random_numbers(const FunctionCall& call);
size_t next_of_drawing(const FunctionCall& call);

/// Warns that an argument has the wrong type, and returns undef. `expected` names the right one.
Value not_converted(const FunctionCall& call, size_t argument, std::string_view expected);
/// Returns undef for an argument that is no vector, which may be said.
Value no_vector(const FunctionCall& call, size_t argument);
/// Warns of the first argument that is no number, and returns undef.
Value no_number(const FunctionCall& call);

}  // namespace language::functions
