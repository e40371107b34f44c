// OpenSCAD's builtin functions (LANGUAGE.md, "Builtin functions").
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string_view>

#include "language/place.hpp"
#include "language/value.hpp"
#include "messages/messages.hpp"

namespace language {

/// What builtin functions use besides their arguments; one per evaluation.
struct FunctionEnvironment {
  Messages& messages;
  std::mt19937 random;  // of rands(), seeded by time and process unless a call seeds it
  /// Names of the user modules on the stack, outermost first: parent_module() reads them.
  std::span<const std::string_view> module_names;
};

struct FunctionCall {
  std::span<const Value> arguments;  // evaluated left to right, names ignored
  Place place;                       // of the call
  FunctionEnvironment& environment;
};

constexpr uint16_t kAnyCount = 0xFFFF;

struct BuiltinFunction {
  std::string_view name;
  uint16_t least_arguments;  // fewer or more: "‹f›() number of parameters does not match", undef,
  uint16_t most_arguments;  // and no argument is evaluated
  Value (*call)(const FunctionCall& call);
};

/// All but those which the evaluator has to see through: is_undef, echo, assert, let, dxf_dim and
/// dxf_cross. Sorted by name.
std::span<const BuiltinFunction> builtin_functions();

}  // namespace language
