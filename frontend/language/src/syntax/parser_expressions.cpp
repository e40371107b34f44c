// Expressions; each function's grammar is in LANGUAGE.md, "Grammar".
#include <array>

#include "syntax/parser.hpp"

namespace language {

namespace {

struct Operator {
  uint8_t level = 0;  // 1 binds least; 0: no binary operator
  BinaryOperator op = BinaryOperator::kOr;
};

constexpr std::array<Operator, kTokenKinds> kOperators = [] {
  std::array<Operator, kTokenKinds> operators{};
  const auto add = [&](TokenKind kind, uint8_t level, BinaryOperator op) {
    operators[static_cast<size_t>(kind)] = {level, op};
  };
  add(TokenKind::kOr, 1, BinaryOperator::kOr);
  add(TokenKind::kAnd, 2, BinaryOperator::kAnd);
  add(TokenKind::kEqual, 3, BinaryOperator::kEqual);
  add(TokenKind::kNotEqual, 3, BinaryOperator::kNotEqual);
  add(TokenKind::kLess, 4, BinaryOperator::kLess);
  add(TokenKind::kLessEqual, 4, BinaryOperator::kLessEqual);
  add(TokenKind::kGreater, 4, BinaryOperator::kGreater);
  add(TokenKind::kGreaterEqual, 4, BinaryOperator::kGreaterEqual);
  add(TokenKind::kBar, 5, BinaryOperator::kBitOr);
  add(TokenKind::kAmpersand, 6, BinaryOperator::kBitAnd);
  add(TokenKind::kShiftLeft, 7, BinaryOperator::kShiftLeft);
  add(TokenKind::kShiftRight, 7, BinaryOperator::kShiftRight);
  add(TokenKind::kPlus, 8, BinaryOperator::kAdd);
  add(TokenKind::kMinus, 8, BinaryOperator::kSubtract);
  add(TokenKind::kStar, 9, BinaryOperator::kMultiply);
  add(TokenKind::kSlash, 9, BinaryOperator::kDivide);
  add(TokenKind::kPercent, 9, BinaryOperator::kModulo);
  return operators;
}();

Operator binary_operator(const Token& token) { return kOperators[static_cast<size_t>(token.kind)]; }

}  // namespace

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
      return parse_operators(parse_unary(), start);
  }
}

/// Reads the binary operators behind an operand, and `?`.
const Expression* Parser::parse_operators(const Expression* left, Place start) {
  if (binary_operator(peek()).level > 0) left = parse_binary(left, start, 1);
  return peek().is('?') ? parse_conditional(left, start) : left;
}

const Expression* Parser::parse_conditional(const Expression* condition, Place start) {
  const Nested nested(*this, 4);
  expect('?');
  const Expression* then_value = parse_expression();
  expect(':');
  const Expression* else_value = parse_expression();
  return make<TernaryExpression>(ExpressionKind::kTernary, start, condition, then_value,
                                 else_value);
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
  switch (token.kind) {
    case TokenKind::kMinus:
      return parse_prefixed(UnaryOperator::kNegate);
    case TokenKind::kExclamation:
      return parse_prefixed(UnaryOperator::kNot);
    case TokenKind::kTilde:
      return parse_prefixed(UnaryOperator::kComplement);
    case TokenKind::kPlus: {
      const Nested nested(*this, 1);
      consume();
      return parse_unary();
    }
    default: {
      const Place start = token.place;
      return parse_postfix(parse_primary(), start);
    }
  }
}

const Expression* Parser::parse_prefixed(UnaryOperator op) {
  const Nested nested(*this, 1);
  const Place start = take_place();
  const Expression* operand = parse_unary();
  if (op == UnaryOperator::kNegate && operand->kind == ExpressionKind::kNumber &&
      program_.dialect.has_negative_numbers) {
    const double number = as<NumberExpression>(*operand).value;
    return make<NumberExpression>(ExpressionKind::kNumber, start, -number);
  }
  return make<UnaryExpression>(ExpressionKind::kUnary, start, op, operand);
}

/// Reads the calls, indices and members behind an operand, and its exponent. Calls nest to the
/// left: f()()() is no chain that a loop could follow.
const Expression* Parser::parse_postfix(const Expression* operand, Place start) {
  for (uint32_t calls = 0;;) {
    switch (peek().kind) {
      case TokenKind::kOpenParenthesis: {
        if (++calls > program_.dialect.most_chained_calls) lexer_.fail("memory exhausted");
        const Nested nested(*this, 2);
        consume();
        const auto arguments = parse_arguments();
        expect(')');
        operand = make<CallExpression>(ExpressionKind::kCall, start, operand, arguments);
        break;
      }
      case TokenKind::kOpenBracket:
        operand = parse_index(operand, start);
        break;
      case TokenKind::kDot:
        consume();
        operand = make<MemberExpression>(ExpressionKind::kMember, start, operand, expect_name());
        break;
      case TokenKind::kCaret:
        return parse_power(operand, start);
      default:
        return operand;
    }
  }
}

/// The exponent is a whole unary expression.
const Expression* Parser::parse_power(const Expression* base, Place start) {
  const Nested nested(*this, 2);
  expect('^');
  const Expression* exponent = parse_unary();
  return make<BinaryExpression>(ExpressionKind::kBinary, start, BinaryOperator::kPower, base,
                                exponent);
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
      return make_of_token<NumberExpression>(ExpressionKind::kNumber, &Token::number);
    case TokenKind::kString:
      return make_of_token<StringExpression>(ExpressionKind::kString, &Token::text);
    case TokenKind::kName:
      return make_of_token<VariableExpression>(ExpressionKind::kVariable, &Token::name);
    case TokenKind::kOpenBracket:
      return parse_bracket();
    default:
      break;
  }
  const Nested nested(*this, 1);
  expect('(');
  const Expression* inner = parse_expression();
  expect(')');
  return inner;
}

const Expression* Parser::parse_function_literal() {
  const Nested nested(*this, 5);
  const Place place = take_place();
  expect('(');
  const auto parameters = parse_parameters();
  expect(')');
  const Expression* body = parse_expression();
  return make<FunctionExpression>(ExpressionKind::kFunction, place, parameters, body);
}

/// Reads let, assert or echo. The latter two need no body.
const Expression* Parser::parse_body_expression(ExpressionKind kind) {
  const Nested nested(*this, 4);
  const Place place = take_place();
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
    case TokenKind::kOpenParenthesis:
    case TokenKind::kOpenBracket:
    case TokenKind::kMinus:
    case TokenKind::kPlus:
    case TokenKind::kExclamation:
    case TokenKind::kTilde:
      return true;
    default:
      return false;
  }
}

/// Reads up to `)`, or to the `;` of a C-style for.
std::span<const Argument> Parser::parse_arguments() {
  ArenaList<Argument> arguments(arguments_);
  const auto is_at_end = [&] { return peek().is(')') || peek().is(';'); };
  if (accept_leading_commas() == 0 && is_at_end()) return {};
  for (;;) {
    arguments.push(parse_argument());
    const int commas = accept_commas();
    // OpenSCAD 2021.01 knows no comma behind the last argument.
    if (commas == 0 || (commas == 1 && is_at_end())) return make(arguments);
  }
}

Argument Parser::parse_argument() {
  const Place place = peek().place;
  if (!peek().is(TokenKind::kName) || !peek_second().is('='))
    return {kNoName, parse_expression(), place};
  const Name name = take_name();
  consume();
  const Nested nested(*this, 2);
  return {name, parse_expression(), place};
}

/// In 2021.01 any number of commas may stand between, before and behind parameters.
std::span<const Parameter> Parser::parse_parameters() {
  ArenaList<Parameter> parameters(parameters_);
  accept_leading_commas();
  while (peek().is(TokenKind::kName)) {
    parameters.push(parse_parameter());
    if (accept_commas() == 0) break;
  }
  return make(parameters);
}

Parameter Parser::parse_parameter() {
  const Place place = peek().place;
  const Name name = take_name();
  return {name, accept('=') ? parse_expression() : nullptr, place};
}

}  // namespace language
