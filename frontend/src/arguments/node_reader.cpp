#include "arguments/node_reader.hpp"

#include <algorithm>
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

ArgumentValue NodeReader::find(language::ArgumentName name, size_t position) const {
  ArgumentValue positional;
  size_t seen = 0;
  for (const language::NodeArgument& argument : arguments()) {
    if (argument.name == name) return {tree_, argument};
    if (argument.name.is_positional() && seen++ == position) positional = {tree_, argument};
  }
  return positional;
}

std::optional<double> NodeReader::number(language::ArgumentName name, size_t position) const {
  const ArgumentValue value = find(name, position);
  if (!value.is_number()) return std::nullopt;
  return value.number();
}

std::string_view NodeReader::text(language::ArgumentName name, size_t position) const {
  const ArgumentValue value = find(name, position);
  return value.is_string() ? value.text() : std::string_view();
}

ValueList NodeReader::list(language::ArgumentName name, size_t position) {
  const ArgumentValue list = find(name, position);
  if (list.is_list()) return list.elements();
  tell_wrong_type(name.text(), list, "a list");
  return {};
}

bool NodeReader::center(const ArgumentValue& value) {
  if (value.kind() == ValueKind::kBool) return value.boolean();
  tell_wrong_type("center", value, "true or false");
  return false;
}

csgcore::FacetSettings NodeReader::facets() const {
  const csgcore::FacetSettings defaults;
  return {number("$fn").value_or(defaults.fn), number("$fa").value_or(defaults.fa),
          number("$fs").value_or(defaults.fs),
          std::max(number("$fe").value_or(defaults.tolerance), defaults.tolerance)};
}

void NodeReader::tell_wrong(std::string_view argument, const std::string& found,
                            std::string_view consequence, std::string_view wanted) {
  tell({": " + std::string(argument) + " is " + found + ", and " + std::string(consequence),
        "it must be " + std::string(wanted)});
}

void NodeReader::tell_wrong_type(std::string_view argument, const ArgumentValue& found,
                                 std::string_view wanted) {
  if (found.is_undef()) return;
  tell_wrong(argument, std::string(name_of(found.kind())), kMissing, wanted);
}

}  // namespace frontend
