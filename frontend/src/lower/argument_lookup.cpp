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

std::string scalar_text(const Value& value) {
  if (value.kind == ValueKind::kUndef) return "undef";
  if (value.kind == ValueKind::kBool) return value.boolean ? "true" : "false";
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%g", value.number);
  return text.data();
}

void note_wrong(NodeProblems& problems, const SyntaxNode& node, std::string_view argument,
                const std::string& found, std::string_view consequence, std::string_view wanted) {
  problems.add(node,
               {": " + std::string(argument) + " is " + found + ", and " + std::string(consequence),
                "it must be " + std::string(wanted)});
}

void note_wrong_type(NodeProblems& problems, const SyntaxNode& node, std::string_view argument,
                     const Value& found, std::string_view wanted) {
  if (found.kind == ValueKind::kUndef) return;
  note_wrong(problems, node, argument, std::string(name_of(found.kind)), kMissing, wanted);
}

bool read_center(const SyntaxNode& node, const Value& value, NodeProblems& problems) {
  if (value.kind == ValueKind::kBool) return value.boolean;
  note_wrong_type(problems, node, "center", value, "true or false");
  return false;
}

const Value* find_argument(const SyntaxTree& tree, const SyntaxNode& node, std::string_view name,
                           size_t position) {
  const Value* positional = nullptr;
  size_t seen = 0;
  for (const Argument& argument : tree.arguments_of(node)) {
    if (argument.name == name) return &argument.value;
    if (argument.name.empty() && seen++ == position) positional = &argument.value;
  }
  return positional;
}

std::optional<double> number_argument(const SyntaxTree& tree, const SyntaxNode& node,
                                      std::string_view name, size_t position) {
  const Value* value = find_argument(tree, node, name, position);
  if (value == nullptr || value->kind != ValueKind::kNumber) return std::nullopt;
  return value->number;
}

std::span<const Value> list_argument(const SyntaxTree& tree, const SyntaxNode& node,
                                     std::string_view name, size_t position,
                                     NodeProblems& problems) {
  const Value* list = find_argument(tree, node, name, position);
  if (list == nullptr) return {};
  if (list->kind == ValueKind::kList) return tree.elements_of(*list);
  note_wrong_type(problems, node, name, *list, "a list");
  return {};
}

}  // namespace frontend
