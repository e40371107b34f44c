// A call of a builtin function.
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
  std::string_view name;       // of the function
  std::span<Value> arguments;  // evaluated left to right, names ignored; a call may move them away
  Place place;                 // of the call
  FunctionEnvironment& environment;

  /// Says a warning at the call.
  void warn(std::string text) const { environment.messages.warn(std::move(text), place); }
};

constexpr uint16_t kAnyCount = 0xFFFF;

struct BuiltinFunction {
  std::string_view name;
  uint16_t least_arguments;  // fewer or more: "‹f›() number of parameters does not match", undef,
  uint16_t most_arguments;  // and no argument is evaluated
  Value (*call)(const FunctionCall& call);
};

}  // namespace language
