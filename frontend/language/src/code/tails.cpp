// The bodies of functions. A call in tail position of a function by its own name starts its frame
// anew (LANGUAGE.md, "Scopes and calls").
#include <algorithm>

#include "code/code_compiler.hpp"
#include "code/expression_facts.hpp"

namespace language {
namespace {

/// Slots from here on are not given up: Instruction::flag has 16 bits.
constexpr uint32_t kMostGivenUp = 0xFFFF;

}  // namespace

void CodeCompiler::compile_function(FunctionEntry& function) {
  function_ = &function;
  const auto& names = function.parameters.slot_names;
  out_.code().slots = static_cast<uint32_t>(names.size());
  out_.set_depth(out_.code().slots);
  const uint32_t start = out_.here();
  defaults_of_callee(function);
  parameter_scope_ = &open_scope(contains_literal(*function.body), function.place);
  const uint32_t open = out_.here() - 1;
  body_start_ = compiler_.dialect().has_all_tail_calls ? start : out_.here();
  for (uint32_t slot = 0; slot < names.size(); ++slot) {
    ScopeVariable& variable = parameter_scope_->add(names[slot], slot);
    variable.is_set = variable.is_always_set = slot < function.parameters.declared_slots;
    variable.is_optional = !variable.is_set;
    if (!parameter_scope_->is_in_heap) continue;
    out_.emit(Op::kLocal, function.place, 1, slot);
    out_.emit(Op::kStoreScoped, function.place, -1, slot, 0);
  }
  if (parameter_scope_->is_in_heap) set_scope_size(open, *parameter_scope_);
  bind_parameters(function);
  tail(*function.body);
}

/// Lets the callee itself evaluate the defaults of what is not given, outside of its own scope.
void CodeCompiler::defaults_of_callee(const Callable& callable) {
  if (!compiler_.dialect().has_arguments_first) return;
  const ParameterList& parameters = callable.parameters;
  for (uint32_t slot = 0; slot < parameters.declared_slots; ++slot) {
    const Expression* const value = parameters.defaults[slot];
    if (!value || constant_value(*value).is_set()) continue;
    const uint32_t given = out_.emit(Op::kTryLocal, callable.place, 0, slot);
    expression(*value);
    out_.at(given).flag = static_cast<uint16_t>(out_.here() - given - 1);
    out_.emit(Op::kStoreLocal, callable.place, -1, slot);
  }
}

/// Lets the callee bind the `$` names among its parameters, and those that a call passes it.
void CodeCompiler::bind_parameters(const Callable& callable) {
  const NameList& names = callable.parameters.slot_names;
  for (uint32_t slot = 0; slot < names.size(); ++slot) {
    if (!is_dynamic_name(names[slot], compiler_.names())) continue;
    const uint32_t given = out_.emit(Op::kTryLocal, callable.place, 0, slot, 0, 1);
    const uint32_t none = out_.emit(Op::kJump, callable.place, 1);
    out_.emit(Op::kBindDynamic, callable.place, -1, names[slot]);
    out_.land(none);
    static_cast<void>(given);
  }
}

void CodeCompiler::compile_defaults(Callable& callable, bool is_module) {
  finds_all_set_ = is_module;
  const uint32_t slots = callable.parameters.declared_slots;
  out_.code().slots = slots;
  out_.set_depth(slots);
  const auto& targets = callable.parameters.targets;
  for (size_t number = 0; number < targets.size(); ++number) {
    const Expression* value = callable.written_parameters[number].value;
    const Target& target = targets[number];
    if (!target.is_dynamic && (!value || constant_value(*value).is_set())) continue;
    if (value) {
      expression(*value);
    } else {
      out_.emit(Op::kUndef, callable.place, 1);
    }
    if (target.is_dynamic) {
      out_.emit(Op::kBindDynamic, callable.place, -1, target.name);
    } else {
      out_.emit(Op::kStoreLocal, callable.place, -1, target.slot);
    }
  }
  out_.emit(Op::kReturnDefaults, callable.place, 0);
}

void CodeCompiler::tail(const Expression& body) {
  const uint32_t depth = out_.depth();
  ScopeLayout* const scope = scope_;
  switch (body.kind) {
    case ExpressionKind::kTernary: {
      const auto& ternary = as<TernaryExpression>(body);
      const uint32_t is_false = jump_if_false(*ternary.condition);
      tail(*ternary.then_value);
      out_.land(is_false);
      tail(*ternary.else_value);
      break;
    }
    case ExpressionKind::kLet:
    case ExpressionKind::kAssert:
    case ExpressionKind::kEcho: {
      const auto& inner = as<BodyExpression>(body);
      if (body.kind == ExpressionKind::kLet) {
        const bool is_in_heap = contains_literal(body);
        open_scope(is_in_heap, body.place);
        let_arguments(inner.arguments, is_in_heap);
      } else if (body.kind == ExpressionKind::kAssert) {
        assert_arguments(inner.arguments, body.place);
      } else {
        echo_arguments(inner.arguments, body.place);
      }
      if (inner.body) {
        tail(*inner.body);
      } else {
        out_.emit(Op::kUndef, body.place, 1);
        out_.emit(Op::kReturn, body.place, -1);
      }
      break;
    }
    case ExpressionKind::kCall:
      tail_call(as<CallExpression>(body));
      break;
    default:
      expression(body);
      out_.emit(Op::kReturn, body.place, -1);
  }
  scope_ = scope;
  out_.set_depth(depth);
}

void CodeCompiler::tail_call(const CallExpression& call) {
  return compiler_.dialect().has_all_tail_calls ? any_tail_call(call) : named_tail_call(call);
}

void CodeCompiler::any_tail_call(const CallExpression& call) {
  const bool is_named = call.callee->kind == ExpressionKind::kVariable;
  const Name name = is_named ? as<VariableExpression>(*call.callee).name : kNoName;
  const uint32_t region = begin_region();
  if (!is_named || compiler_.names().is_dynamic(name) || may_be_variable(name)) {
    dynamic_call(call, true);
  } else if (const auto found = compiler_.find_function(*scope_, name); found.entry == function_) {
    tail_jump(call);
    return end_region(region, name, call.callee, call.place, true);
  } else if (found.entry) {
    static_call(call, found, true);
  } else {
    named_call(call, name);
  }
  end_region(region, name, call.callee, call.place, true);
  out_.emit(Op::kReturn, call.place, -1);
}

/// Starts the frame of the function that is compiled anew, as a call of it would begin.
void CodeCompiler::tail_jump(const CallExpression& call) {
  const uint32_t depth = out_.depth();
  const ArgumentPlan plan = compiler_.plan(*function_, call.arguments, call.place);
  std::vector<uint32_t> slots;  // where the values on the stack belong
  std::vector<CodeRange> values;
  for (const ArgumentPlan::Step& step : plan.steps) {
    const Argument& argument = call.arguments[step.argument];
    const uint32_t begin = out_.here();
    expression(*argument.value);
    values.push_back({begin, out_.here()});
    if (step.is_dropped) {
      out_.emit(Op::kPop, argument.place, -1);
    } else {
      slots.push_back(step.target.slot);
    }
  }
  warn_of_arguments(plan, call.place, false);
  for (const CodeRange& value : values) {
    const std::optional<uint32_t> slot = local_of_call(value);
    if (slot && !is_read(*slot, {value.end, out_.here()})) give_up(*slot, value);
  }
  for (auto slot = slots.rbegin(); slot != slots.rend(); ++slot)
    out_.emit(Op::kStoreLocal, call.place, -1, *slot);
  for (uint32_t slot = 0; slot < function_->parameters.slot_names.size(); ++slot) {
    if (std::find(slots.begin(), slots.end(), slot) != slots.end()) continue;
    const bool is_declared = slot < function_->initial.size();
    out_.constant(is_declared ? function_->initial[slot] : Value::unset(), call.place);
    out_.emit(Op::kStoreLocal, call.place, -1, slot);
  }
  for (const ScopeLayout* scope = scope_; scope != parameter_scope_->parent; scope = scope->parent)
    if (scope->is_in_heap) out_.emit(Op::kPopScope, call.place, 0);
  out_.emit(Op::kTailJump, call.place, 0, body_start_, out_.code().slots);
  out_.set_depth(depth);
}

void CodeCompiler::named_tail_call(const CallExpression& call) {
  const bool is_named = call.callee->kind == ExpressionKind::kVariable;
  const Name name = is_named ? as<VariableExpression>(*call.callee).name : kNoName;
  const bool may_loop = is_named && (function_->literal || name == function_->name);
  uint32_t is_other = 0;
  if (may_loop) {
    const uint32_t depth = out_.depth();
    if (function_->literal) is_other = out_.emit(Op::kUnlessCalledAs, call.place, 0, 0, name);
    const ArgumentPlan plan = compiler_.plan(*function_, call.arguments, call.place);
    warn_of_arguments(plan, call.place, true);
    std::vector<uint32_t> slots;  // where the values on the stack belong
    std::vector<CodeRange> values;
    tail_defaults(plan, slots, call.place);
    for (const ArgumentPlan::Step& step : plan.steps) {
      const Argument& argument = call.arguments[step.argument];
      const uint32_t begin = out_.here();
      expression(*argument.value);
      values.push_back({begin, out_.here()});
      if (step.target.is_dynamic) {
        out_.emit(Op::kBindDynamic, argument.place, -1, step.target.name);
      } else {
        slots.push_back(step.target.slot);
      }
    }
    for (const CodeRange& value : values) {
      const std::optional<uint32_t> slot = local_of_call(value);
      if (slot && !is_read(*slot, {value.end, out_.here()})) give_up(*slot, value);
    }
    for (auto slot = slots.rbegin(); slot != slots.rend(); ++slot)
      out_.emit(Op::kStoreLocal, call.place, -1, *slot);
    for (const ScopeLayout* scope = scope_; scope != parameter_scope_; scope = scope->parent)
      if (scope->is_in_heap) out_.emit(Op::kPopScope, call.place, 0);
    out_.emit(Op::kTailJump, call.place, 0, body_start_, out_.code().slots);
    out_.set_depth(depth);
    if (!function_->literal) return;
    out_.land(is_other);
  }
  expression(call);
  out_.emit(Op::kReturn, call.place, -1);
}

std::optional<uint32_t> CodeCompiler::local_of_call(CodeRange value) const {
  const auto& code = out_.code().instructions;
  if (value.end == value.begin || code[value.end - 1].op != Op::kCallBuiltin) return std::nullopt;
  const Instruction& first = code[value.begin];
  if (first.op != Op::kLocal || first.b >= kMostGivenUp) return std::nullopt;
  return first.b;
}

bool CodeCompiler::is_read(uint32_t slot, CodeRange range) const {
  const auto begin = out_.code().instructions.begin();
  return std::any_of(begin + range.begin, begin + range.end, [slot](const Instruction& step) {
    if (step.op == Op::kLocal || step.op == Op::kTryLocal) return step.b == slot;
    return (step.op == Op::kIndexLocal || step.op == Op::kMemberLocal) && step.a == slot;
  });
}

void CodeCompiler::give_up(uint32_t slot, CodeRange value) {
  out_.at(value.end - 1).flag = static_cast<uint16_t>(slot + 1);
}

// Parameters that a tail call does not give. A default that is no constant is evaluated by the
// first such call, among the variables that it sees there, and kept.
void CodeCompiler::tail_defaults(const ArgumentPlan& plan, std::vector<uint32_t>& slots,
                                 Place place) {
  const auto& targets = function_->parameters.targets;
  for (size_t number = 0; number < targets.size(); ++number) {
    const Target& target = targets[number];
    const auto is_given = [&](const ArgumentPlan::Step& step) {
      return step.target.name == target.name;
    };
    if (std::any_of(plan.steps.begin(), plan.steps.end(), is_given)) continue;
    const Expression* value = function_->written_parameters[number].value;
    const Value constant = value ? constant_value(*value) : Value::undef();
    if (constant.is_set()) {
      out_.constant(constant, place);
    } else {
      auto& caches = out_.code().caches;
      caches.push_back(Value::unset());
      const auto cache = static_cast<uint32_t>(caches.size() - 1);
      const uint32_t cached = out_.emit(Op::kCachedDefault, place, 0, 0, cache);
      expression(*value);
      out_.emit(Op::kStoreCache, place, 0, 0, cache);
      out_.land(cached);
    }
    if (target.is_dynamic) {
      out_.emit(Op::kBindDynamic, place, -1, target.name);
    } else {
      slots.push_back(target.slot);
    }
  }
}

}  // namespace language
