#include "code/constants.hpp"

#include <algorithm>
#include <vector>

#include "language/make.hpp"

namespace language {
namespace {

Value constant_vector(const VectorExpression& vector) {
  std::vector<Value> elements;
  for (const Expression* element : vector.elements) {
    elements.push_back(constant_value(*element));
    if (!elements.back().is_set()) return Value::unset();
  }
  return make_vector(elements);
}

Value constant_negation(const UnaryExpression& unary) {
  if (unary.op != UnaryOperator::kNegate || unary.operand->kind != ExpressionKind::kNumber)
    return Value::unset();
  return -as<NumberExpression>(*unary.operand).value;
}

bool is_literal_range(const RangeExpression& range) {
  return is_literal(*range.begin) && is_literal(*range.end) &&
         (!range.step || is_literal(*range.step));
}

}  // namespace

Value constant_value(const Expression& expression) {
  switch (expression.kind) {
    case ExpressionKind::kUndef:
      return Value::undef();
    case ExpressionKind::kBool:
      return Value::boolean(as<BoolExpression>(expression).value);
    case ExpressionKind::kNumber:
      return as<NumberExpression>(expression).value;
    case ExpressionKind::kString:
      return make_string(as<StringExpression>(expression).text);
    case ExpressionKind::kUnary:
      return constant_negation(as<UnaryExpression>(expression));
    case ExpressionKind::kVector:
      return constant_vector(as<VectorExpression>(expression));
    default:
      return Value::unset();
  }
}

bool is_literal(const Expression& expression) {
  switch (expression.kind) {
    case ExpressionKind::kUndef:
    case ExpressionKind::kBool:
    case ExpressionKind::kNumber:
    case ExpressionKind::kString:
      return true;
    case ExpressionKind::kUnary:
      return is_literal(*as<UnaryExpression>(expression).operand);
    case ExpressionKind::kVector: {
      const auto elements = as<VectorExpression>(expression).elements;
      return std::all_of(elements.begin(), elements.end(),
                         [](const Expression* element) { return is_literal(*element); });
    }
    case ExpressionKind::kRange:
      return is_literal_range(as<RangeExpression>(expression));
    default:
      return false;
  }
}

}  // namespace language
