// What stands in brackets: vectors with their comprehensions, and ranges.
#include "syntax/parser.hpp"

namespace language {

/// Reads a vector or a range.
const Expression* Parser::parse_bracket() {
  const Nested nested(*this, 1);
  const Place start = take_place();
  const bool has_commas = accept_leading_commas() > 0;
  if (accept(']'))
    return make<VectorExpression>(ExpressionKind::kVector, start,
                                  std::span<const Expression* const>{});
  if (has_commas) fail_at_token();
  const Element first = parse_element(program_.dialect.has_comprehension_first);
  if (!first.is_comprehension && peek().is(':')) return parse_range(first.node, start);
  return parse_vector(first, start);
}

const Expression* Parser::parse_range(const Expression* begin, Place start) {
  const Nested nested(*this, 2);
  expect(':');
  const Expression* step = nullptr;
  const Expression* end = parse_expression();
  if (accept(':')) {
    step = end;
    end = parse_expression();
  }
  expect(']');
  return make<RangeExpression>(ExpressionKind::kRange, start, begin, step, end);
}

/// Reads the elements behind the first. Commas may stand behind the last element.
const Expression* Parser::parse_vector(const Element& first, Place start) {
  ArenaList<const Expression*> elements(elements_);
  elements.push(first.node);
  while (accept_commas() > 0 && !peek().is(']')) {
    const Nested nested(*this, 2);
    elements.push(parse_element(true).node);
  }
  expect(']');
  return make<VectorExpression>(ExpressionKind::kVector, start, make(elements));
}

Parser::Element Parser::parse_element(bool may_be_parenthesised) {
  switch (peek().kind) {
    case TokenKind::kLet:
      return parse_let_element();
    case TokenKind::kFor:
      return {parse_for(), true};
    case TokenKind::kIf:
      return {parse_if_element(), true};
    case TokenKind::kEach: {
      const Nested nested(*this, 1);
      const Place place = take_place();
      return {make<EachExpression>(ExpressionKind::kEach, place, parse_element(true).node), true};
    }
    default:
      break;
  }
  if (may_be_parenthesised && peek().is('(')) return parse_parenthesised_element();
  return {parse_expression(), false};
}

/// Only what stands behind `(` tells whether this is a comprehension, or an operand in parentheses.
Parser::Element Parser::parse_parenthesised_element() {
  const Nested nested(*this, 1);
  const Place start = expect('(');
  const Element inner = parse_element(false);
  expect(')');
  if (inner.is_comprehension) return inner;
  const Expression* operand = parse_postfix(inner.node, start);
  return {parse_operators(operand, start), false};
}

/// A let whose body is no comprehension is an expression like any other.
Parser::Element Parser::parse_let_element() {
  const Nested nested(*this, 4);
  const Place place = take_place();
  expect('(');
  const auto arguments = parse_arguments();
  expect(')');
  const Element body = parse_element(true);
  return {make<BodyExpression>(ExpressionKind::kLet, place, arguments, body.node),
          body.is_comprehension};
}

const Expression* Parser::parse_for() {
  const Nested nested(*this, 4);
  const Place place = take_place();
  expect('(');
  const auto init = parse_arguments();
  if (accept(')')) return make_for(init, parse_element(true).node, place);
  expect(';');
  const Expression* condition = parse_expression();
  expect(';');
  const auto increment = parse_arguments();
  expect(')');
  const Expression* body = parse_element(true).node;
  return make<ForCExpression>(ExpressionKind::kForC, place, init, condition, increment, body);
}

const Expression* Parser::make_for(std::span<const Argument> variables, const Expression* body,
                                   Place place) {
  if (program_.dialect.joins_loops) {
    return make<BodyExpression>(ExpressionKind::kFor, place, variables, body);
  }
  for (size_t i = variables.size(); i-- > 0;)
    body = make<BodyExpression>(ExpressionKind::kFor, place, variables.subspan(i, 1), body);
  return body;
}

const Expression* Parser::parse_if_element() {
  const Nested nested(*this, 4);
  const Place place = take_place();
  expect('(');
  const Expression* condition = parse_expression();
  expect(')');
  const Expression* then_element = parse_element(true).node;
  const Expression* else_element = nullptr;
  if (peek().is(TokenKind::kElse)) {
    consume();
    else_element = parse_element(true).node;
  }
  return make<IfExpression>(ExpressionKind::kIf, place, condition, then_element, else_element);
}

}  // namespace language
