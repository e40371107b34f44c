// Expressions; each function's grammar is in LANGUAGE.md, "Grammar".
#include "syntax/parser.hpp"

namespace language {

const Expression* Parser::parse_expression() {
  const Place start = peek().place;
  switch (peek().kind) {
    case TokenKind::kFunction:
      return parse_function_literal();
    case TokenKind::kLet:
      return parse_body_expression(ExpressionKind::kLet);
    case TokenKind::kAssert:
      return parse_body_expression(ExpressionKind::kAssert);
    case TokenKind::kEcho:
      return parse_body_expression(ExpressionKind::kEcho);
    default:
      return parse_conditional(parse_binary(parse_unary(), start, 1), start);
  }
}

const Expression* Parser::parse_conditional(const Expression* condition, Place start) {
  if (!accept('?')) return condition;
  const Nested nested(*this, 4);
  const Expression* then_value = parse_expression();
  expect(':');
  const Expression* else_value = parse_expression();
  return make<TernaryExpression>(ExpressionKind::kTernary, start, condition, then_value,
                                 else_value);
}

Parser::Operator Parser::binary_operator(const Token& token) const {
  switch (token.kind) {
    case TokenKind::kOr:
      return {1, BinaryOperator::kOr};
    case TokenKind::kAnd:
      return {2, BinaryOperator::kAnd};
    case TokenKind::kEqual:
      return {3, BinaryOperator::kEqual};
    case TokenKind::kNotEqual:
      return {3, BinaryOperator::kNotEqual};
    case TokenKind::kLessEqual:
      return {4, BinaryOperator::kLessEqual};
    case TokenKind::kGreaterEqual:
      return {4, BinaryOperator::kGreaterEqual};
    case TokenKind::kShiftLeft:
      return {7, BinaryOperator::kShiftLeft};
    case TokenKind::kShiftRight:
      return {7, BinaryOperator::kShiftRight};
    case TokenKind::kSign:
      break;
    default:
      return {};
  }
  switch (token.sign) {
    case '<':
      return {4, BinaryOperator::kLess};
    case '>':
      return {4, BinaryOperator::kGreater};
    case '|':
      return {5, BinaryOperator::kBitOr};
    case '&':
      return {6, BinaryOperator::kBitAnd};
    case '+':
      return {8, BinaryOperator::kAdd};
    case '-':
      return {8, BinaryOperator::kSubtract};
    case '*':
      return {9, BinaryOperator::kMultiply};
    case '/':
      return {9, BinaryOperator::kDivide};
    case '%':
      return {9, BinaryOperator::kModulo};
    default:
      return {};
  }
}

/// Reads the operators behind an operand that bind at least as tightly as a level. Those of one
/// level associate to the left.
const Expression* Parser::parse_binary(const Expression* left, Place start, int least_level) {
  for (;;) {
    const Operator found = binary_operator(peek());
    if (found.level < least_level) return left;
    const Nested nested(*this, 2);
    consume();
    const Place right_start = peek().place;
    const Expression* right = parse_unary();
    if (binary_operator(peek()).level > found.level)
      right = parse_binary(right, right_start, found.level + 1);
    left = make<BinaryExpression>(ExpressionKind::kBinary, start, found.op, left, right);
  }
}

const Expression* Parser::parse_unary() {
  const Token& token = peek();
  const Place start = token.place;
  const char sign = token.sign;
  if (sign != '-' && sign != '!' && sign != '+' && sign != '~')
    return parse_power(parse_postfix(parse_primary(), start), start);
  const Nested nested(*this, 1);
  consume();
  const Expression* operand = parse_unary();
  if (sign == '+') return operand;
  const UnaryOperator op = sign == '-'   ? UnaryOperator::kNegate
                           : sign == '!' ? UnaryOperator::kNot
                                         : UnaryOperator::kComplement;
  return make<UnaryExpression>(ExpressionKind::kUnary, start, op, operand);
}

/// The exponent is a whole unary expression.
const Expression* Parser::parse_power(const Expression* base, Place start) {
  if (!peek().is('^')) return base;
  const Nested nested(*this, 2);
  consume();
  const Expression* exponent = parse_unary();
  return make<BinaryExpression>(ExpressionKind::kBinary, start, BinaryOperator::kPower, base,
                                exponent);
}

/// Reads the calls, indices and members behind an operand. Calls nest to the left: f()()() is no
/// chain that a loop could follow.
const Expression* Parser::parse_postfix(const Expression* operand, Place start) {
  constexpr uint32_t kMostCalls = 20'000;
  for (uint32_t calls = 0;;) {
    if (peek().is('(')) {
      if (++calls > kMostCalls) lexer_.fail("memory exhausted");
      const Nested nested(*this, 2);
      consume();
      const auto arguments = parse_arguments();
      expect(')');
      operand = make<CallExpression>(ExpressionKind::kCall, start, operand, arguments);
    } else if (peek().is('[')) {
      operand = parse_index(operand, start);
    } else if (accept('.')) {
      operand = make<MemberExpression>(ExpressionKind::kMember, start, operand, expect_name().name);
    } else {
      return operand;
    }
  }
}

const Expression* Parser::parse_index(const Expression* container, Place start) {
  const Nested nested(*this, 2);
  expect('[');
  const Expression* index = parse_expression();
  expect(']');
  return make<IndexExpression>(ExpressionKind::kIndex, start, container, index);
}

const Expression* Parser::parse_primary() {
  const Place place = peek().place;
  switch (peek().kind) {
    case TokenKind::kTrue:
      consume();
      return make<BoolExpression>(ExpressionKind::kBool, place, true);
    case TokenKind::kFalse:
      consume();
      return make<BoolExpression>(ExpressionKind::kBool, place, false);
    case TokenKind::kUndef:
      consume();
      return make<Expression>(ExpressionKind::kUndef, place);
    case TokenKind::kNumber:
      return make<NumberExpression>(ExpressionKind::kNumber, place, take().number);
    case TokenKind::kString:
      return make<StringExpression>(ExpressionKind::kString, place, take().text);
    case TokenKind::kName:
      return make<VariableExpression>(ExpressionKind::kVariable, place, take().name);
    default:
      break;
  }
  if (peek().is('[')) return parse_bracket();
  const Nested nested(*this, 1);
  expect('(');
  const Expression* inner = parse_expression();
  expect(')');
  return inner;
}

const Expression* Parser::parse_function_literal() {
  const Nested nested(*this, 5);
  const Place place = take().place;
  expect('(');
  const auto parameters = parse_parameters();
  expect(')');
  const Expression* body = parse_expression();
  return make<FunctionExpression>(ExpressionKind::kFunction, place, parameters, body);
}

/// Reads let, assert or echo. The latter two need no body.
const Expression* Parser::parse_body_expression(ExpressionKind kind) {
  const Nested nested(*this, 4);
  const Place place = take().place;
  expect('(');
  const auto arguments = parse_arguments();
  expect(')');
  const bool has_body = kind == ExpressionKind::kLet || begins_expression();
  const Expression* body = has_body ? parse_expression() : nullptr;
  return make<BodyExpression>(kind, place, arguments, body);
}

bool Parser::begins_expression() {
  switch (peek().kind) {
    case TokenKind::kFunction:
    case TokenKind::kLet:
    case TokenKind::kAssert:
    case TokenKind::kEcho:
    case TokenKind::kTrue:
    case TokenKind::kFalse:
    case TokenKind::kUndef:
    case TokenKind::kName:
    case TokenKind::kNumber:
    case TokenKind::kString:
      return true;
    case TokenKind::kSign:
      break;
    default:
      return false;
  }
  return std::string_view("([-+!~").find(peek().sign) != std::string_view::npos;
}

/// Reads up to `)`, or to the `;` of a C-style for.
std::span<const Argument> Parser::parse_arguments() {
  ArenaList<Argument> arguments(arguments_);
  const auto is_at_end = [&] { return peek().is(')') || peek().is(';'); };
  while (!is_at_end()) {
    const int commas = accept_commas();
    // OpenSCAD 2021.01 knows no comma behind the last argument.
    if (commas == 1 && arguments.size() > 0 && is_at_end()) break;
    arguments.push(parse_argument());
    if (!peek().is(',')) break;
  }
  return arguments.finish(*arena_);
}

Argument Parser::parse_argument() {
  const Place place = peek().place;
  if (!peek().is(TokenKind::kName) || !peek_second().is('='))
    return {kNoName, parse_expression(), place};
  const Name name = take().name;
  consume();
  const Nested nested(*this, 2);
  return {name, parse_expression(), place};
}

/// Any number of commas may stand between, before and behind parameters.
std::span<const Parameter> Parser::parse_parameters() {
  ArenaList<Parameter> parameters(parameters_);
  accept_commas();
  while (peek().is(TokenKind::kName)) {
    parameters.push(parse_parameter());
    if (accept_commas() == 0) break;
  }
  return parameters.finish(*arena_);
}

Parameter Parser::parse_parameter() {
  const Token name = take();
  return {name.name, accept('=') ? parse_expression() : nullptr, name.place};
}

}  // namespace language
