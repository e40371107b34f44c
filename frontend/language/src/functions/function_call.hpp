// A call of a builtin function.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "files/named_files.hpp"
#include "language/place.hpp"
#include "language/value.hpp"
#include "messages/messages.hpp"

namespace language {

/// What builtin functions use besides their arguments; one per evaluation.
struct FunctionEnvironment {
  Messages& messages;
  NamedFiles& files;
  std::mt19937 random;  // of rands(), seeded by time and process unless a call seeds it
  /// Names of the user modules on the stack, outermost first: parent_module() reads them.
  std::span<const std::string_view> module_names{};
  /// What dxf_dim() and dxf_cross() have found.
  std::unordered_map<std::string, Value> measures{};
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

struct BuiltinFunction {
  std::string_view name;
  uint16_t least_arguments;  // fewer or more: "‹f›() number of parameters does not match", undef,
  uint16_t most_arguments;  // and no argument is evaluated
  Value (*call)(const FunctionCall& call);
  /// A function that does not evaluate all its arguments has this: it returns which of the written
  /// arguments is evaluated next, given those that have been, or kNoArgument. Each value is added
  /// to the call's arguments, also where an argument is evaluated for a second time. Null: all are
  /// evaluated, in the order in which they are written.
  size_t (*next_argument)(const FunctionCall& call) = nullptr;
};

}  // namespace language
