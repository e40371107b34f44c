// let, assert and echo as expressions.
#include "code/code_compiler.hpp"

namespace language {

void CodeCompiler::body_or_undef(const Expression* body, Place place) {
  if (body) return expression(*body);
  out_.emit(Op::kUndef, place, 1);
}

void CodeCompiler::body_expression(const BodyExpression& expression) {
  switch (expression.kind) {
    case ExpressionKind::kAssert:
      assert_arguments(expression.arguments, expression.place);
      return body_or_undef(expression.body, expression.place);
    case ExpressionKind::kEcho:
      echo_arguments(expression.arguments, expression.place);
      return body_or_undef(expression.body, expression.place);
    default:
      return bound_body(expression);
  }
}

bool CodeCompiler::contains_literal(std::span<const Argument> arguments) {
  for (const Argument& argument : arguments)
    if (argument.value && contains_literal(*argument.value)) return true;
  return false;
}

void CodeCompiler::bound_body(const BodyExpression& let) {
  const bool has_dynamic = names_dynamic(let.arguments, compiler_.names());
  if (has_dynamic) out_.emit(Op::kMarkTrail, let.place, 1);
  const uint32_t base = out_.depth();
  const bool is_in_heap = contains_literal(let);
  open_scope(is_in_heap, let.place);
  let_arguments(let.arguments, is_in_heap);
  body_or_undef(let.body, let.place);
  close_scope(let.place);
  const uint32_t locals = out_.depth() - 1 - base;
  if (locals) out_.emit(Op::kSlide, let.place, -static_cast<int>(locals), locals);
  if (has_dynamic) out_.emit(Op::kEndDynamic, let.place, -1);
}

void CodeCompiler::let_arguments(std::span<const Argument> arguments, bool is_in_heap) {
  ScopeLayout& scope = *scope_;
  if (is_in_heap) {
    const uint32_t open = out_.here() - 1;
    for (const Argument& argument : arguments) {
      if (argument.name != kNoName && !is_dynamic_name(argument.name, compiler_.names()))
        scope.declare(argument.name);
    }
    set_scope_size(open, scope);
  }
  NameList done;
  for (const Argument& argument : arguments) {
    body_or_undef(argument.value, argument.place);
    const bool is_known = done.find(argument.name) != NameList::kNone;
    if (argument.name == kNoName) {
      out_.emit(Op::kUnnamedLet, argument.place, -1);
    } else if (is_known) {
      out_.emit(Op::kDuplicateLet, argument.place, -1, argument.name);
    } else {
      done.add(argument.name);
      let_argument(argument, scope);
    }
  }
}

void CodeCompiler::let_argument(const Argument& argument, ScopeLayout& scope) {
  if (scope.is_in_heap || is_dynamic_name(argument.name, compiler_.names()))
    return store(argument.name, argument.place);
  scope.add(argument.name, out_.depth() - 1).is_set = true;
}

// The condition and the message are evaluated; what else is given is not.
void CodeCompiler::assert_arguments(std::span<const Argument> arguments, Place place) {
  NameTable& names = const_cast<NameTable&>(compiler_.names());
  const Name parameters[] = {names.intern("condition"), names.intern("message")};
  ParameterList list(parameters, names);
  const ArgumentPlan plan = plan_arguments(arguments, list, 2, place, names, compiler_.dialect());
  warn_of_arguments(plan, place, false);
  const Expression* chosen[2] = {nullptr, nullptr};
  for (const ArgumentPlan::Step& step : plan.steps) {
    if (step.is_for(2)) chosen[step.target.slot] = arguments[step.argument].value;
  }
  if (chosen[0]) {
    expression(*chosen[0]);
  } else if (compiler_.dialect().misses_condition) {
    variable(parameters[0], place);
  } else {
    out_.emit(Op::kUndef, place, 1);
  }
  if (chosen[1]) expression(*chosen[1]);
  auto& asserts = out_.code().asserts;
  asserts.push_back({chosen[0]});
  out_.emit(Op::kAssert, place, chosen[1] ? -2 : -1, static_cast<uint32_t>(asserts.size() - 1), 0,
            chosen[1] ? 1 : 0);
}

void CodeCompiler::echo_arguments(std::span<const Argument> arguments, Place place) {
  EchoSite site;
  for (const Argument& argument : arguments) {
    expression(*argument.value);
    site.names.push_back(argument.name);
  }
  auto& echoes = out_.code().echoes;
  echoes.push_back(std::move(site));
  out_.emit(Op::kEcho, place, -static_cast<int>(arguments.size()),
            static_cast<uint32_t>(echoes.size() - 1));
}

}  // namespace language
