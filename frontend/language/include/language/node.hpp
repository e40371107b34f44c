// The tree of nodes that a design evaluates to: what OpenSCAD writes as .csg.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "language/place.hpp"
#include "language/value.hpp"

namespace language {

/// How the .csg writer spells an argument (LANGUAGE.md, "Builtin modules").
enum class ArgumentStyle : uint8_t {
  kGeneral,        // "%g" numbers, vectors as [G, G]
  kGeneralTight,   // the same without blanks: [G,G,G]
  kEcho,           // as echo() spells values
  kInteger,        // a number that is printed as an integer
  kUnsigned,       // as an unsigned one of 32 bits
  kRawString,      // in quotes, nothing escaped
  kEscapedString,  // in quotes, with \t \n \r \" \\ escaped
};

struct NodeArgument {
  std::string_view name;  // static storage; empty: positional
  Value value;            // in full double precision
  ArgumentStyle style = ArgumentStyle::kGeneral;
};

struct Node {
  std::string_view name;                // as .csg spells it, static storage: "cube", "group"
  uint8_t modifiers = 0;                // bits of CallModifier (syntax/syntax.hpp)
  Place place;                          // of the module call that made it
  std::vector<NodeArgument> arguments;  // in the order in which .csg lists them
  std::vector<std::shared_ptr<Node>>
      children;  // shared: children(i) yields the child's node itself
};

}  // namespace language
