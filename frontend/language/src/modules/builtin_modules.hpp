// OpenSCAD's builtin modules, from their arguments to nodes (LANGUAGE.md, "Builtin modules").
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "language/node.hpp"
#include "language/place.hpp"
#include "language/value.hpp"
#include "messages/messages.hpp"

namespace language {

/// What builtin modules use besides their arguments; one per evaluation.
struct ModuleEnvironment {
  Messages& messages;
  std::string main_folder;     // absolute; paths in the .csg are relative to it
  std::string unit_folder;     // of the code being evaluated: where imports are looked up first
  bool checks_ranges = false;  // --check-parameter-ranges
};

/// A call whose arguments are resolved and evaluated.
struct BuiltinCall {
  /// By declared parameter, positional ones first, in BuiltinModule's order. Unset: not given.
  std::span<const Value> parameters;
  /// The call's unnamed arguments as they stand, for the modules that look at them
  /// (linear_extrude's height).
  std::span<const Value> unnamed;
  /// $fn, $fa and $fs as the call sees them.
  Value fragments_number, fragments_angle, fragments_size;
  Place place;  // of the call
  ModuleEnvironment& environment;
};

/// What becomes of the call's children.
enum class ChildRule : uint8_t {
  kTakes,    // they become the node's children
  kRefuses,  // "module ‹n›() does not support child modules", not evaluated
  kIgnores,  // silently not evaluated
};

struct BuiltinModule {
  std::string_view name;
  std::span<const std::string_view> positional;  // declared parameters, in order
  std::span<const std::string_view> named_only;
  ChildRule children;
  /// Fills in the node's name and arguments and says what is wrong with them. Returns false if
  /// there is to be no node.
  bool (*make)(const BuiltinCall& call, Node& node);
};

/// All whose arguments are resolved by the rules of user modules. Left to the evaluator: for,
/// intersection_for, let, assign, if, echo, assert, children, child, each, group, union,
/// difference, intersection. Sorted by name.
std::span<const BuiltinModule> builtin_modules();

}  // namespace language
