#include "values/operator_problem.hpp"

namespace language {
namespace {

void append_types(std::string& out, const Value& left, std::string_view sign, const Value& right) {
  out += '(';
  out += type_name(left.type());
  out += ' ';
  out += sign;
  out += ' ';
  out += type_name(right.type());
  out += ')';
}

}  // namespace

std::string undefined_operation(const Value& left, std::string_view sign, const Value& right) {
  std::string text = "undefined operation ";
  append_types(text, left, sign, right);
  return text;
}

std::string operation_undefined(const Value& left, std::string_view sign, const Value& right) {
  std::string text = "operation undefined ";
  append_types(text, left, sign, right);
  return text;
}

}  // namespace language
