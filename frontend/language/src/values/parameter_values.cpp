#include "values/parameter_values.hpp"

#include "values/value_text.hpp"

namespace language {

double number_or(const Value& value, double otherwise) {
  return value.is_number() ? value.number() : otherwise;
}

std::string_view text_or(const Value& value, std::string_view otherwise) {
  return value.is_string() ? value.text() : otherwise;
}

std::string shown(const Value& value) { return value.is_set() ? echo_text(value) : "undef"; }

std::string wrong_type(std::string_view callee, std::string_view parameter,
                       std::string_view expected, const Value& found) {
  return std::string(callee) + "(..., " + std::string(parameter) + "=" + shown(found) +
         ") Invalid type: expected " + std::string(expected) + ", found " +
         std::string(type_name(found.type()));
}

}  // namespace language
