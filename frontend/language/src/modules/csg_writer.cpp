#include "language/csg_writer.hpp"

#include <array>
#include <charconv>
#include <utility>

#include "base/number_text.hpp"
#include "values/value_text.hpp"

namespace language {
namespace {

/// Appends a number, a boolean, or a vector of these.
void append_general(std::string& out, const Value& value, std::string_view separator) {
  if (value.is_number()) {
    append_general_number(out, value.number());
  } else if (value.is_vector()) {
    out += '[';
    std::string_view before;
    for (const Value& element : value.elements()) {
      out += std::exchange(before, separator);
      append_general(out, element, separator);
    }
    out += ']';
  } else {
    append_echo_text(out, value);
  }
}

void append_integer(std::string& out, double number) {
  std::array<char, 24> digits;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<int64_t>(number)).ptr;
  out.append(digits.data(), end);
}

void append_escaped(std::string& out, std::string_view text) {
  constexpr std::string_view kEscaped = "\t\n\r\"\\", kLetters = "tnr\"\\";
  for (const char c : text) {
    const size_t found = kEscaped.find(c);
    if (found != std::string_view::npos) out += '\\';
    out += found != std::string_view::npos ? kLetters[found] : c;
  }
}

void append_value(std::string& out, const NodeArgument& argument) {
  switch (argument.style) {
    case ArgumentStyle::kGeneral:
      return append_general(out, argument.value, ", ");
    case ArgumentStyle::kGeneralTight:
      return append_general(out, argument.value, ",");
    case ArgumentStyle::kEcho:
      return append_echo_text(out, argument.value);
    case ArgumentStyle::kInteger:
      return append_integer(out, argument.value.number());
    case ArgumentStyle::kRawString:
      out += '"';
      out += argument.value.text();
      out += '"';
      return;
    case ArgumentStyle::kEscapedString:
      out += '"';
      append_escaped(out, argument.value.text());
      out += '"';
      return;
  }
}

/// Appends modifiers, indentation, name and arguments. A root (!) has lost its other modifiers.
void append_head(std::string& out, const Node& node, size_t depth) {
  const bool is_root = depth == 0 && (node.modifiers & kRootModifier) != 0;
  if (!is_root && (node.modifiers & kBackgroundModifier) != 0) out += '%';
  if (!is_root && (node.modifiers & kHighlightModifier) != 0) out += '#';
  out.append(depth, '\t');
  out += node.name;
  out += '(';
  std::string_view before;
  for (const NodeArgument& argument : node.arguments) {
    out += std::exchange(before, ", ");
    if (!argument.name.empty()) out.append(argument.name).append(" = ");
    append_value(out, argument);
  }
  out += ')';
}

/// Appends a node and everything below it.
void append_tree(std::string& out, const Node& top) {
  struct Open {
    const Node* node;
    size_t next;  // child
  };
  std::vector<Open> open;
  const auto begin = [&](const Node& node) {
    append_head(out, node, open.size());
    if (node.children.empty()) {
      out += ";\n";
    } else {
      out += " {\n";
      open.push_back({&node, 0});
    }
  };
  begin(top);
  while (!open.empty()) {
    Open& innermost = open.back();
    if (innermost.next < innermost.node->children.size()) {
      begin(*innermost.node->children[innermost.next++]);
      continue;
    }
    open.pop_back();
    out.append(open.size(), '\t') += "}\n";
  }
}

}  // namespace

std::string csg_text(const Node& root) {
  std::string out;
  if (const Node* const shown = root_modifiers(root).shown) {
    append_tree(out, *shown);
  } else {
    for (const std::shared_ptr<Node>& node : root.children) append_tree(out, *node);
  }
  out += '\n';
  return out;
}

}  // namespace language
