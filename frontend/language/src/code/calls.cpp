// Function calls.
#include <algorithm>

#include "code/code_compiler.hpp"

namespace language {

void CodeCompiler::end_region(uint32_t begin, Name name, const Expression* callee, Place place,
                              bool is_tail) {
  const std::string_view text = name == kNoName ? std::string_view() : compiler_.names().text(name);
  out_.code().regions.push_back({begin, out_.here(), text, callee, place, false, is_tail});
}

void CodeCompiler::call(const CallExpression& call) {
  const uint32_t region = begin_region();
  Name name = kNoName;
  if (call.callee->kind == ExpressionKind::kVariable) {
    name = as<VariableExpression>(*call.callee).name;
    named_call(call, name);
  } else {
    dynamic_call(call, false);
  }
  end_region(region, name, call.callee, call.place);
}

void CodeCompiler::named_call(const CallExpression& call, Name name) {
  if (compiler_.names().is_dynamic(name) || may_be_variable(name)) return dynamic_call(call, false);
  if (const auto found = compiler_.find_function(*scope_, name); found.entry)
    return static_call(call, found, false);
  if (name == compiler_.known().is_undef) return is_undef_call(call);
  if (compiler_.builtins().functions.count(name)) return builtin_call(call, name);
  out_.emit(Op::kUnknownFunction, call.place, 1, name);
}

void CodeCompiler::builtin_call(const CallExpression& call, Name name) {
  const FunctionShape& shape = compiler_.builtins().functions.at(name);
  const size_t count = call.arguments.size();
  if (count < shape.least_arguments || count > shape.most_arguments)
    return wrong_count(call, shape.index);
  if (!shape.parameters.empty()) return assigned_call(call, shape);
  if (shape.is_lazy) return lazy_call(call, shape.index);
  for (const Argument& argument : call.arguments) expression(*argument.value);
  out_.emit(Op::kCallBuiltin, call.place, 1 - static_cast<int>(count), shape.index,
            static_cast<uint32_t>(count));
}

/// Calls a builtin function with a value for each of its parameters.
void CodeCompiler::assigned_call(const CallExpression& call, const FunctionShape& shape) {
  const auto count = static_cast<uint32_t>(shape.parameters.size());
  const ArgumentPlan plan =
      compiler_.plan_builtin(shape.parameters, count, call.arguments, call.place);
  const uint32_t base = out_.depth();
  for (uint32_t slot = 0; slot < count; ++slot) out_.constant(Value::unset(), call.place);
  for (const ArgumentPlan::Step& step : plan.steps) {
    const Argument& argument = call.arguments[step.argument];
    expression(*argument.value);
    if (step.is_for(count)) {
      out_.emit(Op::kStoreLocal, argument.place, -1, base + step.target.slot);
    } else {
      out_.emit(Op::kPop, argument.place, -1);
    }
  }
  warn_of_arguments(plan, call.place, false);
  out_.emit(Op::kCallBuiltin, call.place, 1 - static_cast<int>(count), shape.index, count);
}

void CodeCompiler::wrong_count(const CallExpression& call, uint32_t builtin) {
  const uint32_t start = out_.depth();
  if (!compiler_.dialect().has_lazy_functions && builtin != kIsUndefFunction)
    for (const Argument& argument : call.arguments) expression(*argument.value);
  drop_to(start, call.place);
  out_.emit(Op::kWarnCount, call.place, 1, builtin, static_cast<uint32_t>(call.arguments.size()));
}

void CodeCompiler::lazy_call(const CallExpression& call, uint32_t builtin) {
  constexpr uint32_t kMostRepeated = 2;  // arguments that are evaluated once more
  const auto written = static_cast<uint32_t>(call.arguments.size());
  LazyCall site{builtin, written, out_.depth(), written + kMostRepeated};
  const auto number = static_cast<uint32_t>(out_.code().lazy_calls.size());
  out_.code().lazy_calls.push_back(site);
  out_.constant(0.0, call.place);
  for (uint32_t slot = 0; slot < site.room; ++slot) out_.constant(Value::unset(), call.place);
  const uint32_t full = out_.depth();
  const uint32_t next = out_.emit(Op::kNextLazy, call.place, 0, number);
  const uint32_t done = out_.emit(Op::kJump, call.place, 0);
  for (const Argument& argument : call.arguments) {
    out_.set_depth(full);
    site.argument_code.push_back(out_.here());
    site.argument_names.push_back(argument.name == kNoName ? std::string_view()
                                                           : compiler_.names().text(argument.name));
    expression(*argument.value);
    out_.emit(Op::kKeepLazy, argument.place, -1, number);
    out_.emit(Op::kJump, argument.place, 0, next);
  }
  out_.land(done);
  out_.code().lazy_calls[number] = std::move(site);
  out_.set_depth(full - site.room);
}

void CodeCompiler::is_undef_call(const CallExpression& call) {
  if (call.arguments.size() != 1) return wrong_count(call, kIsUndefFunction);
  const Expression& argument = *call.arguments[0].value;
  if (argument.kind == ExpressionKind::kVariable) {  // which may be unknown
    const Name name = as<VariableExpression>(argument).name;
    if (is_dynamic_name(name, compiler_.names())) {
      out_.emit(Op::kDynamicSilently, argument.place, 1, name);
    } else {
      variable_or(name, argument.place, Op::kUndef);
    }
  } else {
    expression(argument);
  }
  out_.emit(Op::kIsUndef, call.place, 0);
}

/// Returns whether a call itself binds `$` names.
bool CodeCompiler::binds_dynamic(const Callable& callable, const ArgumentPlan& plan) const {
  const auto& targets = callable.parameters.targets;
  return std::any_of(targets.begin(), targets.end(),
                     [](const Target& target) { return target.is_dynamic; }) ||
         std::any_of(plan.steps.begin(), plan.steps.end(),
                     [](const ArgumentPlan::Step& step) { return step.target.is_dynamic; });
}

// The slots of undeclared names follow those of the parameters. The defaults know none of them,
// since calls that are compiled later may add some.
void CodeCompiler::begin_call(const ParameterList& parameters, Place place, uint32_t number) {
  const uint32_t declared = parameters.declared_slots;
  out_.emit(Op::kBeginCall, place, static_cast<int>(declared), number);
  for (size_t slot = declared; slot < parameters.slot_names.size(); ++slot)
    out_.constant(Value::unset(), place);
}

void CodeCompiler::warn_of_arguments(const ArgumentPlan& plan, Place place, bool once) {
  if (plan.warnings.empty()) return;
  auto& plans = out_.code().plans;
  plans.push_back(plan);
  out_.emit(Op::kArgumentWarnings, place, 0, static_cast<uint32_t>(plans.size() - 1), 0,
            once ? 1 : 0);
}

void CodeCompiler::arguments(const ArgumentPlan& plan, std::span<const Argument> arguments,
                             uint32_t base) {
  for (const ArgumentPlan::Step& step : plan.steps) {
    const Argument& argument = arguments[step.argument];
    expression(*argument.value);
    if (step.is_dropped) {
      out_.emit(Op::kPop, argument.place, -1);
    } else if (step.target.is_dynamic) {
      out_.emit(Op::kBindDynamic, argument.place, -1, step.target.name);
    } else {
      out_.emit(Op::kStoreLocal, argument.place, -1, base + step.target.slot);
    }
  }
}

void CodeCompiler::pass_arguments(const ArgumentPlan& plan, std::span<const Argument> given,
                                  uint32_t base, Place place) {
  const bool warns_first = !compiler_.dialect().has_arguments_first;
  if (warns_first) warn_of_arguments(plan, place, false);
  arguments(plan, given, base);
  if (!warns_first) warn_of_arguments(plan, place, false);
}

void CodeCompiler::static_call(const CallExpression& call, Found<FunctionEntry> found,
                               bool is_tail) {
  FunctionEntry& function = *found.entry;
  const ArgumentPlan plan = compiler_.plan(function, call.arguments, call.place);
  const uint32_t unit = function.scope->unit;
  const bool has_mark = binds_dynamic(function, plan) ||
                        (found.is_in_other_unit && compiler_.unit(unit).binds_dynamic);
  if (has_mark) out_.emit(Op::kMarkTrail, call.place, 1);
  if (found.is_in_other_unit) out_.emit(Op::kEnterUnit, call.place, 0, unit);
  const uint32_t base = out_.depth();
  CallSite site;
  site.function = &function;
  site.is_in_unit = found.is_in_other_unit;
  site.scope = found.is_in_other_unit ? 0 : scope_number(*function.scope);
  site.slots = static_cast<uint32_t>(function.parameters.slot_names.size());
  auto& calls = out_.code().calls;
  const auto number = static_cast<uint32_t>(calls.size());
  calls.push_back(site);
  begin_call(function.parameters, call.place, number);
  pass_arguments(plan, call.arguments, base, call.place);
  out_.emit(Op::kCall, call.place, 1 - static_cast<int>(site.slots), number, 0, is_tail ? 1 : 0);
  if (has_mark) out_.emit(Op::kEndDynamic, call.place, -1);
}

/// Pushes what a member or an index selects from, then what it selects.
void CodeCompiler::method(const Expression& callee) {
  const bool is_member = callee.kind == ExpressionKind::kMember;
  expression(is_member ? *as<MemberExpression>(callee).container
                       : *as<IndexExpression>(callee).container);
  const uint32_t container = out_.depth() - 1;
  if (is_member) {
    out_.emit(Op::kMemberLocal, callee.place, 1, as<MemberExpression>(callee).member, container,
              kNoPosition);
  } else {
    expression(*as<IndexExpression>(callee).index);
    out_.emit(Op::kIndexLocal, callee.place, 0, 0, container);
  }
}

void CodeCompiler::dynamic_call(const CallExpression& call, bool is_tail) {
  const ExpressionKind kind = call.callee->kind;
  DynamicCall site;
  site.is_tail = is_tail;
  site.is_method = compiler_.dialect().has_methods &&
                   (kind == ExpressionKind::kMember || kind == ExpressionKind::kIndex);
  site.callee = call.callee;
  site.name = kNoName;
  site.arguments = call.arguments;
  site.slot = out_.depth() + (site.is_method ? 1 : 0);
  if (site.is_method) {
    method(*call.callee);
  } else if (kind == ExpressionKind::kVariable) {
    site.name = as<VariableExpression>(*call.callee).name;
    if (is_dynamic_name(site.name, compiler_.names())) {
      out_.emit(Op::kDynamicSilently, call.callee->place, 1, site.name);
    } else {
      callee_variable(site.name, call.callee->place);
    }
    const auto found = compiler_.find_function(*scope_, site.name);
    site.function = found.entry;
    site.is_in_unit = found.is_in_other_unit;
    if (found.entry) {
      site.unit = found.entry->scope->unit;
      if (!found.is_in_other_unit) site.function_scope = scope_number(*found.entry->scope);
    }
    const auto builtin = compiler_.builtins().functions.find(site.name);
    if (builtin != compiler_.builtins().functions.end()) site.builtin = builtin->second.index;
  } else {
    expression(*call.callee);
  }
  auto& calls = out_.code().dynamic_calls;
  const auto number = static_cast<uint32_t>(calls.size());
  calls.push_back(site);
  const auto count = static_cast<uint32_t>(call.arguments.size());
  if (site.is_in_unit) {
    const uint32_t is_value = out_.emit(Op::kIfFunction, call.place, 0);
    out_.emit(Op::kEnterUnit, call.place, 0, site.unit);
    out_.land(is_value);
  }
  out_.emit(Op::kPrepareCall, call.place, static_cast<int>(count) + 3, number);
  const uint32_t full = out_.depth();
  site.next = out_.emit(Op::kNextArgument, call.place, 0, number);
  out_.emit(Op::kCallDynamic, call.place, 0, number);
  const uint32_t done = out_.emit(Op::kJump, call.place, 0);
  for (uint32_t argument = 0; argument < count; ++argument) {
    out_.set_depth(full);
    site.argument_code.push_back(out_.here());
    const Argument& given = call.arguments[argument];
    expression(*given.value);
    const bool is_bound = given.name != kNoName && is_dynamic_name(given.name, compiler_.names()) &&
                          !compiler_.dialect().has_arguments_first;
    if (is_bound) {
      out_.emit(Op::kBindDynamic, given.place, -1, given.name);
    } else {
      out_.emit(Op::kStoreLocal, given.place, -1, site.slot + 3 + argument);
    }
    out_.emit(Op::kJump, given.place, 0, site.next);
  }
  out_.land(done);
  site.end = out_.here();
  out_.set_depth(full - count - 3);
  if (site.is_method) out_.emit(Op::kSlide, call.place, -1, 1);
  out_.code().dynamic_calls[number] = std::move(site);
}

}  // namespace language
