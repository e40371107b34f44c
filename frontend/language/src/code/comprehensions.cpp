// Comprehensions: what appends elements to a vector.
#include <algorithm>

#include "code/code_compiler.hpp"

namespace language {
namespace {

// Returns whether an element of a comprehension appends exactly one value.
bool appends_one(const Expression* element) {
  while (element && element->kind >= ExpressionKind::kLet && element->kind <= ExpressionKind::kEcho)
    element = as<BodyExpression>(*element).body;
  return !element || element->kind < ExpressionKind::kLet;
}

}  // namespace

void CodeCompiler::element(const Expression& value, uint32_t vector) {
  switch (value.kind) {
    case ExpressionKind::kFor: {
      const auto& loop = as<BodyExpression>(value);
      return for_elements(loop.arguments, loop, contains_literal(value), vector);
    }
    case ExpressionKind::kForC:
      return for_c_elements(as<ForCExpression>(value), vector);
    case ExpressionKind::kIf:
      return if_element(as<IfExpression>(value), vector);
    case ExpressionKind::kEach:
      return each_elements(as<EachExpression>(value), vector);
    case ExpressionKind::kLet:
      return let_element(as<BodyExpression>(value), vector);
    case ExpressionKind::kAssert:
      assert_arguments(as<BodyExpression>(value).arguments, value.place);
      return element_or_undef(as<BodyExpression>(value).body, value.place, vector);
    case ExpressionKind::kEcho:
      echo_arguments(as<BodyExpression>(value).arguments, value.place);
      return element_or_undef(as<BodyExpression>(value).body, value.place, vector);
    default:
      expression(value);
      out_.emit(Op::kAppend, value.place, -1, vector);
  }
}

void CodeCompiler::element_or_undef(const Expression* body, Place place, uint32_t vector) {
  if (body) return element(*body, vector);
  out_.emit(Op::kUndef, place, 1);
  out_.emit(Op::kAppend, place, -1, vector);
}

void CodeCompiler::if_element(const IfExpression& choice, uint32_t vector) {
  const uint32_t is_false = jump_if_false(*choice.condition);
  element(*choice.then_element, vector);
  if (!choice.else_element) return out_.land(is_false);
  const uint32_t done = out_.emit(Op::kJump, choice.place, 0);
  out_.land(is_false);
  element(*choice.else_element, vector);
  out_.land(done);
}

void CodeCompiler::let_element(const BodyExpression& let, uint32_t vector) {
  const bool has_dynamic = names_dynamic(let.arguments, compiler_.names());
  const uint32_t base = out_.depth();
  if (has_dynamic) out_.emit(Op::kMarkTrail, let.place, 1);
  const bool is_in_heap = contains_literal(let);
  open_scope(is_in_heap, let.place);
  let_arguments(let.arguments, is_in_heap);
  element_or_undef(let.body, let.place, vector);
  close_scope(let.place);
  if (has_dynamic) out_.emit(Op::kUndoTrail, let.place, 0, base);
  drop_to(base, let.place);
}

void CodeCompiler::drop_to(uint32_t depth, Place place) {
  while (out_.depth() > depth) out_.emit(Op::kPop, place, -1);
}

void CodeCompiler::for_elements(std::span<const Argument> sources, const BodyExpression& loop,
                                bool is_in_heap, uint32_t vector) {
  if (sources.empty()) return element_or_undef(loop.body, loop.place, vector);
  const Argument& source = sources.front();
  const bool has_name = source.name != kNoName;
  const bool is_dynamic = has_name && is_dynamic_name(source.name, compiler_.names());
  const uint32_t base = out_.depth();
  if (is_dynamic) out_.emit(Op::kMarkTrail, source.place, 1);
  expression(*source.value);
  const uint32_t state = out_.depth() - 1;
  out_.emit(Op::kBeginLoop, loop.place, 2, 0, 0, kElementLoop);
  if (sources.size() == 1 && appends_one(loop.body)) out_.emit(Op::kReserve, loop.place, 0, vector);
  ScopeLayout& scope = open_scope(is_in_heap && has_name && !is_dynamic, source.place);
  const uint32_t open = out_.here() - 1;
  const uint32_t next = out_.emit(Op::kNextRound, loop.place, 1, 0, state);
  if (is_dynamic) {
    out_.emit(Op::kUndoTrail, source.place, 0, base);
    out_.emit(Op::kBindDynamic, source.place, -1, source.name);
  } else if (scope.is_in_heap) {
    scope.declare(source.name);
    set_scope_size(open, scope);
    if (compiler_.dialect().has_scopes_of_rounds) out_.emit(Op::kRenewScope, source.place, 0);
    store(source.name, source.place);
  } else {
    scope.add(has_name ? source.name : kNoName, out_.depth() - 1).is_set = true;
  }
  for_elements(sources.subspan(1), loop, is_in_heap, vector);
  drop_to(state + 3, source.place);
  out_.emit(Op::kJump, loop.place, 0, next);
  out_.land(next);
  close_scope(source.place);
  if (is_dynamic) out_.emit(Op::kUndoTrail, source.place, 0, base);
  drop_to(base, source.place);
}

// One scope serves all rounds. The increments see the new values of those before them; `$` names
// that they set are forgotten.
void CodeCompiler::for_c_elements(const ForCExpression& loop, uint32_t vector) {
  const uint32_t base = out_.depth();
  const bool has_dynamic = names_dynamic(loop.init, compiler_.names()) ||
                           names_dynamic(loop.increment, compiler_.names());
  if (has_dynamic) out_.emit(Op::kMarkTrail, loop.place, 1);
  const uint32_t rounds = out_.depth();
  out_.constant(0.0, loop.place);
  ScopeLayout& scope = open_scope(contains_literal(loop), loop.place);
  const uint32_t open = out_.here() - 1;
  declare_for_c(loop, scope);
  if (scope.is_in_heap) set_scope_size(open, scope);
  for_c_assignments(loop.init, scope);
  for (const Argument& argument : loop.increment) {
    ScopeVariable* variable = scope.find(argument.name);
    if (variable && !variable->is_set) variable->is_optional = true;
  }
  const uint32_t inner_mark = out_.depth();
  const bool forgets = has_dynamic && !compiler_.dialect().keeps_names_of_increments;
  if (forgets) out_.emit(Op::kMarkTrail, loop.place, 1);
  const uint32_t start = out_.here();
  const uint32_t done = jump_if_false(*loop.condition);
  element_or_undef(loop.body, loop.place, vector);
  out_.emit(Op::kCountRound, loop.place, 0, rounds);
  if (scope.is_in_heap && compiler_.dialect().has_scopes_of_rounds)
    out_.emit(Op::kRenewScope, loop.place, 0);
  for_c_assignments(loop.increment, scope);
  if (forgets) out_.emit(Op::kUndoTrail, loop.place, 0, inner_mark);
  out_.emit(Op::kJump, loop.place, 0, start);
  out_.land(done);
  close_scope(loop.place);
  if (has_dynamic) out_.emit(Op::kUndoTrail, loop.place, 0, base);
  drop_to(base, loop.place);
}

void CodeCompiler::declare_for_c(const ForCExpression& loop, ScopeLayout& scope) {
  for (const auto& arguments : {loop.init, loop.increment}) {
    for (const Argument& argument : arguments) {
      if (argument.name == kNoName || is_dynamic_name(argument.name, compiler_.names())) continue;
      if (scope.is_in_heap) {
        scope.declare(argument.name);
      } else if (!scope.find(argument.name)) {
        scope.add(argument.name, out_.depth());
        out_.constant(Value::unset(), loop.place);
      }
    }
  }
}

void CodeCompiler::for_c_assignments(std::span<const Argument> arguments, ScopeLayout& scope) {
  std::vector<Name> done;
  for (const Argument& argument : arguments) {
    const uint32_t begin = out_.here();
    body_or_undef(argument.value, argument.place);
    const CodeRange value{begin, out_.here()};
    if (argument.name == kNoName) {
      out_.emit(Op::kUnnamedLet, argument.place, -1);
    } else if (std::find(done.begin(), done.end(), argument.name) != done.end()) {
      out_.emit(Op::kDuplicateLet, argument.place, -1, argument.name);
    } else {
      const ScopeVariable* variable = scope.find(argument.name);
      const bool was_set = variable && variable->is_set;
      store(argument.name, argument.place);
      const Instruction& stored = out_.at(out_.here() - 1);
      const std::optional<uint32_t> slot = local_of_call(value);
      if (slot && stored.op == Op::kStoreLocal && stored.b == *slot) give_up(*slot, value);
      if (variable && variable->is_optional && !was_set) scope.find(argument.name)->is_set = false;
      done.push_back(argument.name);
    }
  }
}

void CodeCompiler::each_elements(const EachExpression& each, uint32_t vector) {
  const Expression& inner = *each.element;
  if (inner.kind < ExpressionKind::kLet) {
    expression(inner);
    out_.emit(Op::kAppendEach, each.place, -1, vector);
    return;
  }
  const uint32_t produced = out_.depth();
  out_.emit(Op::kBeginVector, each.place, 1);
  element(inner, produced);
  out_.emit(Op::kAppendEachOfAll, each.place, -1, vector);
}

}  // namespace language
