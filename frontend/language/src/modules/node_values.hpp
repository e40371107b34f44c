// What the makers of nodes share: reading parameters, adding arguments, warning.
#pragma once

#include <array>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "modules/builtin_modules.hpp"
#include "values/parameter_values.hpp"

namespace language {

/// Returns the number as an int; `otherwise` if the value is none.
int integer_or(const BuiltinCall& call, const Value& value, int otherwise);
/// Returns the text of a value as str() makes it; nothing of one that is not given.
std::string str_or_nothing(const Value& value);
/// Returns whether the value is the boolean true.
bool is_true_bool(const Value& value);
/// Returns whether the value is a number, neither inf nor nan.
bool is_finite_number(const Value& value);

/// Reads a vector of two numbers. Returns false, and leaves x and y, if the value is none.
bool read_vec2(const Value& value, double& x, double& y);
/// Reads a vector of three numbers, or of two with `filler` as the third. Returns false if the
/// value is neither; the numbers before the first wrong one are set then. Every vector of two
/// elements counts as converted: if one of them is no number, only z is set.
bool read_vec3(const Value& value, std::array<double, 3>& xyz, double filler);

void warn(const BuiltinCall& call, std::string text);
/// Says what is deprecated, without a place.
void deprecate(const BuiltinCall& call, std::string text);

/// $fn, $fa, $fs, $fe as numbers; what is no number is 0.
struct Fragments {
  double number, angle, size;
  double error = 0;  // of a chord; 0: any
};
Fragments fragments_of(const BuiltinCall& call);
/// The same as primitives take them: $fs and $fa are at least 0.01, with a warning for less.
Fragments clamped_fragments(const BuiltinCall& call);
/// Says what clamped_fragments() would, for primitives without fragments, which 2021.01 checks,
/// too.
inline void check_fragments(const BuiltinCall& call) {
  if (call.environment.dialect.checks_unused_fragments) clamped_fragments(call);
}

// The following fill in the last node of a tree.
inline void set_kind(NodeTree& tree, NodeKind kind) { tree.nodes.back().kind = kind; }
void add(NodeTree& tree, ArgumentName name, Value value,
         ArgumentStyle style = ArgumentStyle::kGeneral);
inline void add_numbers(NodeTree& tree, ArgumentName name, std::span<const double> numbers,
                        ArgumentStyle style = ArgumentStyle::kGeneral) {
  tree.add(name, numbers, style);
}
inline void add_numbers(NodeTree& tree, ArgumentName name, std::initializer_list<double> list) {
  tree.add(name, std::span<const double>(list.begin(), list.size()), ArgumentStyle::kGeneral);
}
void add_bool(NodeTree& tree, ArgumentName name, bool value);
void add_integer(NodeTree& tree, ArgumentName name, int64_t value);
void add_raw(NodeTree& tree, ArgumentName name, std::string_view text);
void add_escaped(NodeTree& tree, ArgumentName name, std::string_view text);
void add_fragments(NodeTree& tree, const Fragments& fragments);

}  // namespace language
