// Expressions: each pushes its value.
#include <stdexcept>

#include "code/code_compiler.hpp"
#include "code/expression_facts.hpp"

namespace language {
namespace {

Op op_of(UnaryOperator op) {
  switch (op) {
    case UnaryOperator::kNegate:
      return Op::kNegate;
    case UnaryOperator::kNot:
      return Op::kNot;
    case UnaryOperator::kComplement:
      return Op::kComplement;
  }
  throw std::logic_error("an operator that is none");
}

// Returns the instruction of an operator that evaluates both operands.
Op op_of(BinaryOperator op) {
  switch (op) {
    case BinaryOperator::kPower:
      return Op::kPower;
    case BinaryOperator::kMultiply:
      return Op::kMultiply;
    case BinaryOperator::kDivide:
      return Op::kDivide;
    case BinaryOperator::kModulo:
      return Op::kModulo;
    case BinaryOperator::kAdd:
      return Op::kAdd;
    case BinaryOperator::kSubtract:
      return Op::kSubtract;
    case BinaryOperator::kLess:
      return Op::kLess;
    case BinaryOperator::kLessEqual:
      return Op::kLessEqual;
    case BinaryOperator::kGreater:
      return Op::kGreater;
    case BinaryOperator::kGreaterEqual:
      return Op::kGreaterEqual;
    case BinaryOperator::kEqual:
      return Op::kEqual;
    case BinaryOperator::kNotEqual:
      return Op::kNotEqual;
    case BinaryOperator::kBitAnd:
      return Op::kBitAnd;
    case BinaryOperator::kBitOr:
      return Op::kBitOr;
    case BinaryOperator::kShiftLeft:
      return Op::kShiftLeft;
    case BinaryOperator::kShiftRight:
      return Op::kShiftRight;
    case BinaryOperator::kAnd:
    case BinaryOperator::kOr:
      break;  // logical() makes jumps of them
  }
  throw std::logic_error("an operator that has no instruction");
}

bool is_logical(const Expression& expression) {
  if (expression.kind != ExpressionKind::kBinary) return false;
  const BinaryOperator op = as<BinaryExpression>(expression).op;
  return op == BinaryOperator::kAnd || op == BinaryOperator::kOr;
}

bool is_arithmetic(const Expression& expression) {
  return expression.kind == ExpressionKind::kBinary && !is_logical(expression);
}

MemberPosition member_position(std::string_view name) {
  if (name == "x") return kX;
  if (name == "y") return kY;
  return name == "z" ? kZ : kNoPosition;
}

}  // namespace

void CodeCompiler::expression(const Expression& expression) {
  switch (expression.kind) {
    case ExpressionKind::kUndef:
      out_.emit(Op::kUndef, expression.place, 1);
      return;
    case ExpressionKind::kBool:
    case ExpressionKind::kNumber:
    case ExpressionKind::kString:
      return out_.constant(constant_value(expression), expression.place);
    case ExpressionKind::kVariable:
      return variable(as<VariableExpression>(expression).name, expression.place);
    case ExpressionKind::kUnary:
      return unary(as<UnaryExpression>(expression));
    case ExpressionKind::kBinary:
      return is_logical(expression) ? logical(as<BinaryExpression>(expression))
                                    : binary_chain(as<BinaryExpression>(expression));
    case ExpressionKind::kTernary:
      return ternary(as<TernaryExpression>(expression));
    case ExpressionKind::kIndex:
    case ExpressionKind::kMember:
      return index_chain(expression);
    case ExpressionKind::kCall:
      return call(as<CallExpression>(expression));
    case ExpressionKind::kVector:
      return vector(as<VectorExpression>(expression));
    case ExpressionKind::kRange:
      return range(as<RangeExpression>(expression));
    case ExpressionKind::kFunction:
      return literal(as<FunctionExpression>(expression));
    case ExpressionKind::kLet:
    case ExpressionKind::kAssert:
    case ExpressionKind::kEcho:
      return body_expression(as<BodyExpression>(expression));
    case ExpressionKind::kFor:
    case ExpressionKind::kForC:
    case ExpressionKind::kIf:
    case ExpressionKind::kEach:  // comprehensions stand within vectors only
      out_.emit(Op::kUndef, expression.place, 1);
  }
}

void CodeCompiler::unary(const UnaryExpression& unary) {
  const Value constant = constant_value(unary);
  if (constant.is_set()) return out_.constant(constant, unary.place);
  expression(*unary.operand);
  out_.emit(op_of(unary.op), unary.place, 0);
}

// a + b + c is nested to the left, as deeply as it is long, so the left operands are followed by a
// loop. The code of a right operand stands before that of the left one wherever they may be
// evaluated in this order; operators find the left one on top.
void CodeCompiler::binary_chain(const BinaryExpression& binary) {
  std::vector<const BinaryExpression*> chain{&binary};
  while (is_arithmetic(*chain.back()->left))
    chain.push_back(&as<BinaryExpression>(*chain.back()->left));
  const Expression& first = *chain.back()->left;
  const bool is_any_order = !compiler_.dialect().evaluates_left_first;
  std::vector<bool> is_before(chain.size());
  for (size_t i = 0; i < chain.size(); ++i) {
    is_before[i] =
        is_any_order || is_silent(*chain[i]->right) || (i + 1 == chain.size() && is_silent(first));
    if (is_before[i]) expression(*chain[i]->right);
  }
  expression(first);
  for (size_t i = chain.size(); i-- > 0;) {
    if (!is_before[i]) {
      expression(*chain[i]->right);
      out_.emit(Op::kSwap, chain[i]->place, 0);
    }
    out_.emit(op_of(chain[i]->op), chain[i]->place, -1);
  }
}

/// Returns whether evaluating an expression can neither say anything nor fail.
bool CodeCompiler::is_silent(const Expression& value) const {
  switch (value.kind) {
    case ExpressionKind::kUndef:
    case ExpressionKind::kBool:
    case ExpressionKind::kNumber:
    case ExpressionKind::kString:
      return true;
    case ExpressionKind::kVariable:
      return is_known_variable(as<VariableExpression>(value).name);
    default:
      return false;
  }
}

void CodeCompiler::logical(const BinaryExpression& binary) {
  std::vector<const BinaryExpression*> chain{&binary};
  while (is_logical(*chain.back()->left))
    chain.push_back(&as<BinaryExpression>(*chain.back()->left));
  expression(*chain.back()->left);
  for (auto position = chain.rbegin(); position != chain.rend(); ++position) {
    const BinaryExpression& link = **position;
    const bool is_and = link.op == BinaryOperator::kAnd;
    if (!is_and) out_.emit(Op::kNot, link.place, 0);
    const uint32_t decided = out_.emit(Op::kJumpIfFalse, link.place, -1);
    expression(*link.right);
    out_.emit(Op::kToBool, link.place, 0);
    const uint32_t done = out_.emit(Op::kJump, link.place, -1);
    out_.land(decided);
    out_.emit(Op::kFalse, link.place, 1);
    if (!is_and) out_.emit(Op::kNot, link.place, 0);
    out_.land(done);
  }
}

uint32_t CodeCompiler::jump_if_false(const Expression& condition) {
  expression(condition);
  return out_.emit(Op::kJumpIfFalse, condition.place, -1);
}

void CodeCompiler::ternary(const TernaryExpression& ternary) {
  const uint32_t is_false = jump_if_false(*ternary.condition);
  expression(*ternary.then_value);
  const uint32_t done = out_.emit(Op::kJump, ternary.place, -1);
  out_.land(is_false);
  expression(*ternary.else_value);
  out_.land(done);
}

// v[1][2].x is nested to the left, too. The code of an index stands before that of what it selects
// from wherever they may be evaluated in this order; the container has to be on top.
void CodeCompiler::index_chain(const Expression& outermost) {
  struct Link {
    const Expression* node;
    bool is_before;  // its index has been evaluated
  };
  std::vector<Link> chain;
  const bool is_any_order = !compiler_.dialect().evaluates_left_first;
  const Expression* container = &outermost;
  while (container->kind == ExpressionKind::kIndex || container->kind == ExpressionKind::kMember) {
    if (container->kind == ExpressionKind::kIndex) {
      const auto& link = as<IndexExpression>(*container);
      const bool is_before = is_any_order || is_silent(*link.index) || is_silent(*link.container);
      chain.push_back({container, is_before});
      if (is_before) expression(*link.index);
      container = link.container;
    } else {
      chain.push_back({container, true});
      container = as<MemberExpression>(*container).container;
    }
  }
  const uint32_t start = out_.here();
  expression(*container);
  for (auto position = chain.rbegin(); position != chain.rend(); ++position) {
    const Expression* const* const link = &position->node;
    if (!position->is_before) {
      expression(*as<IndexExpression>(**link).index);
      out_.emit(Op::kSwap, (*link)->place, 0);
    }
    // Elements of a variable need no copy of it.
    const bool is_local = out_.here() == start + 1 && out_.at(start).op == Op::kLocal;
    const uint32_t slot = is_local ? out_.take_back().b : 0;
    if ((*link)->kind == ExpressionKind::kIndex) {
      out_.emit(is_local ? Op::kIndexLocal : Op::kIndex, (*link)->place, is_local ? 0 : -1, 0,
                slot);
    } else {
      const Name name = as<MemberExpression>(**link).member;
      out_.emit(is_local ? Op::kMemberLocal : Op::kMember, (*link)->place, is_local ? 1 : 0, name,
                slot, member_position(compiler_.names().text(name)));
    }
  }
}

// The end is evaluated only after a begin that is a number, the step only after an end that is one.
void CodeCompiler::range(const RangeExpression& range) {
  expression(*range.begin);
  const uint32_t no_begin = out_.emit(Op::kUnlessNumber, range.place, 0);
  expression(*range.end);
  uint32_t no_end = no_begin;
  if (range.step) {
    no_end = out_.emit(Op::kUnlessNumber, range.place, 0);
    expression(*range.step);
  }
  uint16_t flag = range.step ? kHasStep : 0;
  const bool has_literal_step =
      range.step ? is_literal(*range.step) : !compiler_.dialect().swaps_reversed_ranges;
  if (has_literal_step && is_literal(*range.begin) && is_literal(*range.end))
    flag |= kChecksDirection;
  out_.emit(Op::kRange, range.place, range.step ? -2 : -1, 0, 0, flag);
  const uint32_t done = out_.emit(Op::kJump, range.place, -1);
  // Where a part is no number, the parts that were evaluated become undef.
  if (range.step) {
    out_.land(no_end);
    out_.set_depth(out_.depth() + 2);
    out_.emit(Op::kPop, range.place, -1);
    out_.set_depth(out_.depth() - 1);
  }
  out_.land(no_begin);
  out_.set_depth(out_.depth() + 1);
  out_.emit(Op::kPop, range.place, -1);
  out_.emit(Op::kUndef, range.place, 1);
  out_.land(done);
}

void CodeCompiler::vector(const VectorExpression& vector) {
  const Value constant = constant_value(vector);
  if (constant.is_set()) return out_.constant(constant, vector.place);
  bool is_plain = true;
  for (const Expression* element : vector.elements)
    is_plain = is_plain && element->kind < ExpressionKind::kLet;
  if (is_plain) {
    for (const Expression* element : vector.elements) expression(*element);
    const auto count = static_cast<uint32_t>(vector.elements.size());
    out_.emit(Op::kVector, vector.place, 1 - static_cast<int>(count), count);
    return;
  }
  const uint32_t slot = out_.depth();
  out_.emit(Op::kBeginVector, vector.place, 1);
  for (const Expression* value : vector.elements) element(*value, slot);
}

void CodeCompiler::literal(const FunctionExpression& literal) {
  auto& functions = out_.code().functions;
  functions.push_back(&compiler_.add_literal(literal, *scope_));
  out_.emit(Op::kFunction, literal.place, 1, static_cast<uint32_t>(functions.size() - 1));
}

}  // namespace language
