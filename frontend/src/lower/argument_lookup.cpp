#include "lower/argument_lookup.hpp"

#include <array>
#include <cstdio>

namespace frontend {

std::string_view name_of(ValueKind kind) {
  switch (kind) {
    case ValueKind::kUndef:
      return "undef";
    case ValueKind::kBool:
      return "a boolean";
    case ValueKind::kNumber:
      return "a number";
    case ValueKind::kString:
      return "a string";
    case ValueKind::kList:
      return "a list";
  }
  return "";
}

std::string scalar_text(const ArgumentValue& value) {
  if (value.is_undef()) return "undef";
  if (!value.is_number()) return value.boolean() ? "true" : "false";
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%g", value.number());
  return text.data();
}

void note_wrong(NodeProblems& problems, const Node& node, std::string_view argument,
                const std::string& found, std::string_view consequence, std::string_view wanted) {
  problems.add(node,
               {": " + std::string(argument) + " is " + found + ", and " + std::string(consequence),
                "it must be " + std::string(wanted)});
}

void note_wrong_type(NodeProblems& problems, const Node& node, std::string_view argument,
                     const ArgumentValue& found, std::string_view wanted) {
  if (found.is_undef()) return;
  note_wrong(problems, node, argument, std::string(name_of(found.kind())), kMissing, wanted);
}

bool read_center(const Node& node, const ArgumentValue& value, NodeProblems& problems) {
  if (value.kind() == ValueKind::kBool) return value.boolean();
  note_wrong_type(problems, node, "center", value, "true or false");
  return false;
}

ArgumentValue find_argument(const NodeTree& tree, const Node& node, language::ArgumentName name,
                            size_t position) {
  ArgumentValue positional;
  size_t seen = 0;
  for (const language::NodeArgument& argument : tree.arguments_of(node)) {
    if (argument.name == name) return {tree, argument};
    if (argument.name.is_positional() && seen++ == position) positional = {tree, argument};
  }
  return positional;
}

std::optional<double> number_argument(const NodeTree& tree, const Node& node,
                                      language::ArgumentName name, size_t position) {
  const ArgumentValue value = find_argument(tree, node, name, position);
  if (!value.is_number()) return std::nullopt;
  return value.number();
}

ValueList list_argument(const NodeTree& tree, const Node& node, language::ArgumentName name,
                        size_t position, NodeProblems& problems) {
  const ArgumentValue list = find_argument(tree, node, name, position);
  if (list.is_list()) return list.elements();
  note_wrong_type(problems, node, name.text(), list, "a list");
  return {};
}

}  // namespace frontend
