#include "syntax/parameter_value.hpp"

#include <array>
#include <charconv>

#include "syntax/arena.hpp"
#include "syntax/parameter_text.hpp"

namespace language {

namespace {

/// Appends the shortest text that is read as this number.
void append_number(std::string& out, double number) {
  std::array<char, 32> digits;
  out.append(digits.data(), std::to_chars(digits.begin(), digits.end(), number).ptr);
}

void append_string(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  out += '"';
}

std::optional<double> number_of(const Expression* literal) {
  double sign = 1;
  while (literal && literal->kind == ExpressionKind::kUnary &&
         as<UnaryExpression>(*literal).op == UnaryOperator::kNegate) {
    literal = as<UnaryExpression>(*literal).operand;
    sign = -sign;
  }
  if (!literal || literal->kind != ExpressionKind::kNumber) return std::nullopt;
  return sign * as<NumberExpression>(*literal).value;
}

std::optional<ParameterValue> vector_value(const VectorExpression& vector) {
  if (vector.elements.empty()) return std::nullopt;  // which no parameter set can give
  std::vector<double> numbers;
  std::string text = "[";
  for (const Expression* element : vector.elements) {
    if (text.size() > 1) text += ", ";
    if (const auto number = number_of(element)) {
      append_number(text, *number);
      numbers.push_back(*number);
    } else if (element->kind == ExpressionKind::kString) {
      append_string(text, as<StringExpression>(*element).text);
    } else {
      return std::nullopt;
    }
  }
  const bool are_few = numbers.size() <= kMostNumbers;
  if (numbers.size() == vector.elements.size() && are_few) return numbers;
  return LiteralText{ValueType::kVector, text + "]"};
}

std::optional<ParameterValue> range_value(const RangeExpression& range) {
  const auto begin = number_of(range.begin), step = number_of(range.step),
             end = number_of(range.end);
  if (!begin || !end || (range.step && !step)) return std::nullopt;
  std::string text = "[";
  append_number(text, *begin);
  if (step) append_number(text += " : ", *step);
  append_number(text += " : ", *end);
  return LiteralText{ValueType::kRange, text + "]"};
}

ValueType type_of(const ParameterValue& value) {
  if (const auto* literal = std::get_if<LiteralText>(&value)) return literal->type;
  constexpr ValueType kTypes[] = {ValueType::kBool, ValueType::kNumber, ValueType::kString,
                                  ValueType::kVector};
  return kTypes[value.index()];
}

}  // namespace

std::optional<ParameterValue> literal_value(const Expression& literal) {
  switch (literal.kind) {
    case ExpressionKind::kBool:
      return as<BoolExpression>(literal).value;
    case ExpressionKind::kString:
      return std::string(as<StringExpression>(literal).text);
    case ExpressionKind::kVector:
      return vector_value(as<VectorExpression>(literal));
    case ExpressionKind::kRange:
      return range_value(as<RangeExpression>(literal));
    default:
      break;
  }
  const auto number = number_of(&literal);
  return number ? std::optional<ParameterValue>(*number) : std::nullopt;
}

std::string set_text(const ParameterValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* literal = std::get_if<LiteralText>(&value)) return literal->text;
  if (const auto* boolean = std::get_if<bool>(&value)) return *boolean ? "true" : "false";
  std::string text;
  if (const auto* number = std::get_if<double>(&value)) {
    append_number(text, *number);
    return text;
  }
  for (const double number : std::get<std::vector<double>>(value)) {
    append_number(text += text.empty() ? "[" : ", ", number);
  }
  return text + "]";
}

std::optional<ParameterValue> value_of_text(std::string_view text, const ParameterValue& fallback) {
  Arena arena;
  const Expression* literal = parameter_literal(arena, {}, text, type_of(fallback));
  return literal ? literal_value(*literal) : std::nullopt;
}

}  // namespace language
