// The tree of nodes that a design evaluates to: what OpenSCAD writes as .csg.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "language/call_modifier.hpp"
#include "language/place.hpp"
#include "language/value.hpp"

namespace language {

/// How the .csg writer spells an argument (LANGUAGE.md, "Builtin modules").
enum class ArgumentStyle : uint8_t {
  kGeneral,        // "%g" numbers, vectors as [G, G]
  kGeneralTight,   // the same without blanks: [G,G,G]
  kEcho,           // as echo() spells values
  kInteger,        // a whole number, with all of its digits
  kRawString,      // in quotes, nothing escaped
  kEscapedString,  // in quotes, with \t \n \r \" \\ escaped
};

struct NodeArgument {
  std::string_view name;  // static storage; empty: positional
  Value value;            // in full double precision
  ArgumentStyle style = ArgumentStyle::kGeneral;
};

struct Node {
  Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  ~Node();  // does not recurse, however deep the tree is

  std::string_view name;                // as .csg spells it, static storage: "cube", "group"
  uint8_t modifiers = 0;                // CallModifier
  bool is_module_call = false;          // of a module that the design itself defines
  Place place;                          // of the module call that made it
  std::vector<NodeArgument> arguments;  // in the order in which .csg lists them
  std::vector<std::shared_ptr<Node>>
      children;  // shared: children(i) yields the child's node itself
};

/// What a tree's root modifiers (!) ask for.
struct RootModifiers {
  const Node* shown = nullptr;  // the first node that has one, depth first; null: none has
  /// The first one after it that stems from another call: OpenSCAD warns of it.
  std::optional<Place> other{};
};

/// Finds the nodes with root modifiers below `root`.
RootModifiers root_modifiers(const Node& root);

/// Returns whether two trees are the same to the last bit, their places among it.
bool are_same(const Node& a, const Node& b);

}  // namespace language
