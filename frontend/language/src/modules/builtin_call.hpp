// A call of a builtin module, and what a builtin module is.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/named_files.hpp"
#include "language/node_tree.hpp"
#include "language/place.hpp"
#include "language/value.hpp"
#include "messages/messages.hpp"

namespace language {

/// What builtin modules use besides their arguments; one per evaluation.
struct ModuleEnvironment {
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

}  // namespace language
