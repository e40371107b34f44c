#include "code/expression_facts.hpp"

#include <algorithm>
#include <span>
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

using Pending = std::vector<const Expression*>;

void add(Pending& pending, const Expression* expression) {
  if (expression) pending.push_back(expression);
}

void add(Pending& pending, std::span<const Argument> arguments) {
  for (const Argument& argument : arguments) add(pending, argument.value);
}

void add_for_c(Pending& pending, const ForCExpression& loop) {
  add(pending, loop.init);
  add(pending, loop.condition);
  add(pending, loop.increment);
  add(pending, loop.body);
}

void add_operands(Pending& pending, const Expression& expression) {
  switch (expression.kind) {
    case ExpressionKind::kUnary:
      return add(pending, as<UnaryExpression>(expression).operand);
    case ExpressionKind::kBinary:
      add(pending, as<BinaryExpression>(expression).left);
      return add(pending, as<BinaryExpression>(expression).right);
    case ExpressionKind::kTernary:
      add(pending, as<TernaryExpression>(expression).condition);
      add(pending, as<TernaryExpression>(expression).then_value);
      return add(pending, as<TernaryExpression>(expression).else_value);
    case ExpressionKind::kIndex:
      add(pending, as<IndexExpression>(expression).container);
      return add(pending, as<IndexExpression>(expression).index);
    case ExpressionKind::kMember:
      return add(pending, as<MemberExpression>(expression).container);
    case ExpressionKind::kCall:
      add(pending, as<CallExpression>(expression).callee);
      return add(pending, as<CallExpression>(expression).arguments);
    case ExpressionKind::kVector:
      for (const Expression* element : as<VectorExpression>(expression).elements)
        add(pending, element);
      return;
    case ExpressionKind::kRange:
      add(pending, as<RangeExpression>(expression).begin);
      add(pending, as<RangeExpression>(expression).step);
      return add(pending, as<RangeExpression>(expression).end);
    case ExpressionKind::kLet:
    case ExpressionKind::kAssert:
    case ExpressionKind::kEcho:
    case ExpressionKind::kFor:
      add(pending, as<BodyExpression>(expression).arguments);
      return add(pending, as<BodyExpression>(expression).body);
    case ExpressionKind::kForC:
      return add_for_c(pending, as<ForCExpression>(expression));
    case ExpressionKind::kIf:
      add(pending, as<IfExpression>(expression).condition);
      add(pending, as<IfExpression>(expression).then_element);
      return add(pending, as<IfExpression>(expression).else_element);
    case ExpressionKind::kEach:
      return add(pending, as<EachExpression>(expression).element);
    default:
      return;
  }
}

bool search(const Expression& root) {
  Pending pending{&root};
  while (!pending.empty()) {
    const Expression& expression = *pending.back();
    pending.pop_back();
    if (expression.kind == ExpressionKind::kFunction) return true;
    add_operands(pending, expression);
  }
  return false;
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

bool LiteralFinder::contains_literal(const Expression& expression) {
  const auto [place, is_new] = answers_.try_emplace(&expression, false);
  if (is_new) place->second = search(expression);
  return place->second;
}

}  // namespace language
