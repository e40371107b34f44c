#include "evaluation/function_calls.hpp"

#include <string>

#include "language/make.hpp"

namespace language {

namespace {

// Slots, counted from the callee: the number of arguments that are done, the trail's mark, the
// arguments in their order. The evaluated defaults follow.
constexpr uint32_t kDone = 1, kMark = 2, kArguments = 3;

}  // namespace

void FunctionCalls::begin(const CallSite& site) {
  Callable& callable =
      site.module ? static_cast<Callable&>(*site.module) : static_cast<Callable&>(*site.function);
  const uint32_t base = push_parameters(callable);
  if (!callable.has_default_code) return;
  HeapScope* const scope = stack_.scope_around(site.is_in_unit, site.scope);
  stack_.push(compiler_.defaults_of(callable, site.module), base, HeapScopes::acquire(scope),
              FrameKind::kDefaults);
}

void FunctionCalls::return_defaults() {
  const FrameKind kind = stack_.frame().kind;
  const uint32_t base = stack_.base();
  stack_.pop();
  if (kind != FrameKind::kDynamicDefaults) return;
  ValueStack& values = stack_.values;
  Value defaults = make_vector(values.size() - base);
  for (uint32_t slot = base; slot < values.size(); ++slot)
    append_element(defaults, std::move(values[slot]));
  values.drop_to(base);
  values.top() = std::move(defaults);
}

uint32_t FunctionCalls::push_parameters(const Callable& callable) {
  ValueStack& values = stack_.values;
  const uint32_t base = values.size();
  values.reserve(base + static_cast<uint32_t>(callable.initial.size()));
  for (const Value& value : callable.initial) values.push_copy(value);
  return base;
}

void FunctionCalls::call(const CallSite& site, bool is_tail) {
  FunctionEntry& function = *site.function;
  if (!is_tail && stack_.nests_too_deeply())
    stack_.fail_recursion("function", stack_.text_of(function.name), stack_.place());
  HeapScope* const scope = stack_.take_scope_around(site.is_in_unit, site.scope);
  const Code& code = compiler_.code_of(function);
  if (is_tail) {
    check_rounds();
    stack_.replace(code, site.slots, scope);
    stack_.frame().called_as = kNoName;
  } else {
    stack_.push(code, stack_.values.size() - site.slots, scope, FrameKind::kFunction);
  }
  stack_.frame().callee = &function;
  for (uint32_t slot = site.slots; slot < code.slots; ++slot) stack_.values.push(Value::unset());
}

void FunctionCalls::return_value() {
  Value value = stack_.values.pop();
  stack_.leave();
  stack_.values.push(std::move(value));
}

/// Counts a tail call. Fails after too many.
void FunctionCalls::check_rounds() {
  if (!stack_.loops_too_long()) {
    stack_.frame().tail_code = &stack_.code();
    stack_.frame().tail_next = stack_.next();
    return;
  }
  const Frame& frame = stack_.frame();
  const bool is_named = frame.called_as == kNoName && frame.callee->name != kNoName;
  const Name name = is_named ? frame.callee->name : frame.called_as;
  stack_.jump(0);  // a tail call is no call in the traces
  stack_.fail_recursion("function", name == kNoName ? "" : stack_.text_of(name),
                        is_named ? frame.callee->place : frame.call);
}

void FunctionCalls::tail_jump(uint32_t slots, uint32_t target) {
  check_rounds();
  stack_.values.drop_to(stack_.base() + slots);
  stack_.jump(target);
}

void FunctionCalls::call_builtin(uint32_t index, uint32_t count,
                                 std::span<const std::string_view> names) {
  const BuiltinFunction& function = builtins_[index];
  ValueStack& values = stack_.values;
  const std::span<Value> arguments(values.end() - count, count);
  stack_.recorder.note_builtin(function);
  const OperationLimit limit;
  Value value =
      function.call({function.name, count, arguments, stack_.place(), environment_, names});
  values.drop_to(values.size() - count);
  values.push(std::move(value));
}

void FunctionCalls::next_lazy(const LazyCall& site) {
  const BuiltinFunction& function = builtins_[site.builtin];
  const auto count = static_cast<uint32_t>(stack_.slot(site.slot).number());
  const std::span<Value> arguments(&stack_.slot(site.slot + 1), count);
  stack_.recorder.note_builtin(function);
  const FunctionCall call{function.name,  site.written, arguments,
                          stack_.place(), environment_, site.argument_names};
  const size_t next = count == site.room ? kNoArgument : function.next_argument(call);
  if (next != kNoArgument) return stack_.jump(site.argument_code[next]);
  const OperationLimit limit;
  Value value = function.call(call);
  stack_.values.drop_to(stack_.base() + site.slot);
  stack_.values.push(std::move(value));
}

void FunctionCalls::keep_lazy(const LazyCall& site) {
  Value value = stack_.values.pop();
  Value& count = stack_.slot(site.slot);
  const auto number = static_cast<uint32_t>(count.number());
  stack_.slot(site.slot + 1 + number) = std::move(value);
  count = number + 1.0;
}

// A call in tail position says them once in the whole run.
void FunctionCalls::say_argument_warnings(uint32_t plan, bool once) {
  const Code& code = stack_.code();
  if (once) {
    stack_.recorder.note_history();
    if (code.said.empty()) code.said.resize(code.plans.size());
    if (code.said[plan]) return;
    code.said[plan] = true;
  }
  for (const ArgumentWarning& warning : code.plans[plan].warnings)
    environment_.messages.warn(warning.text, warning.place, PathBase::kUnit);
}

void FunctionCalls::warn_count(uint32_t builtin, size_t found) {
  constexpr BuiltinFunction kIsUndef{"is_undef", 1, 1, nullptr};
  const BuiltinFunction& function = builtin == kIsUndefFunction ? kIsUndef : builtins_[builtin];
  stack_.warn(wrong_count(function, found, compiler_.dialect()), PathBase::kMainFile);
  stack_.values.push(Value::undef());
}

void FunctionCalls::unknown_function(Name name) {
  stack_.warn("Ignoring unknown function '" + stack_.text_of(name) + "'", PathBase::kMainFile);
  stack_.values.push(Value::undef());
}

FunctionEntry* DynamicCalls::function_of(const DynamicCall& site) {
  const Value& callee = stack_.slot(site.slot);
  return callee.is_function() ? &closure_of(callee).function : site.function;
}

HeapScope* DynamicCalls::scope_of(const DynamicCall& site) {
  const Value& callee = stack_.slot(site.slot);
  return callee.is_function() ? closure_of(callee).scope
                              : stack_.scope_around(site.is_in_unit, site.function_scope);
}

/// Returns the object whose member is called; null: it is none.
const Value* DynamicCalls::object_of(const DynamicCall& site) {
  if (!site.is_method) return nullptr;
  const Value& container = stack_.slot(site.slot - 1);
  return container.is_object() ? &container : nullptr;
}

const ArgumentPlan& DynamicCalls::plan_of(const DynamicCall& site, FunctionEntry& function) {
  const bool has_this = object_of(site) != nullptr;
  auto& plans = site.plans[has_this ? 1 : 0];
  const auto found = plans.find(&function);
  if (found != plans.end()) return found->second;
  const Name taken = has_this ? compiler_.known().this_ : kNoName;
  return plans.emplace(&function, compiler_.plan(function, site.arguments, stack_.place(), taken))
      .first->second;
}

// Says why the value on top cannot be called, if so.
bool DynamicCalls::refuse_callee(const DynamicCall& site) {
  const Value& callee = stack_.values.top();
  const auto refuse = [&](std::string text, PathBase base) {
    stack_.warn(std::move(text), base);
    return true;
  };
  if (callee.is_function()) {
    if (site.name == kNoName || !is_dynamic_name(site.name, compiler_.names())) return false;
    if (compiler_.dialect().calls_dynamic_names) return false;
    return refuse("Can't call function on dynamically scoped variable", PathBase::kUnit);
  }
  if (site.name == kNoName)
    return refuse("Can't call function on " + std::string(type_name(callee.type())),
                  PathBase::kUnit);
  if (site.function) return false;
  if (!site.builtin)
    return refuse("Ignoring unknown function '" + stack_.text_of(site.name) + "'",
                  PathBase::kMainFile);
  const BuiltinFunction& builtin = builtin_functions()[*site.builtin];
  const size_t count = site.arguments.size();
  const Arity arity = arity_of(builtin, compiler_.dialect());
  if (count >= arity.least && count <= arity.most) return false;
  return refuse(wrong_count(builtin, count, compiler_.dialect()), PathBase::kMainFile);
}

void DynamicCalls::prepare(const DynamicCall& site) {
  ValueStack& values = stack_.values;
  if (refuse_callee(site)) {
    values.top() = Value::undef();
    return stack_.jump(site.end);
  }
  values.push(0.0);
  values.push(static_cast<double>(stack_.dynamic.trail()));
  for (size_t slot = 0; slot <= site.arguments.size(); ++slot) values.push(Value::unset());
  FunctionEntry* const function = function_of(site);
  if (!function) return;
  compiler_.prepare(*function);
  if (!function->has_default_code) return;
  HeapScope* const scope = HeapScopes::acquire(scope_of(site));
  const Code& code = compiler_.defaults_of(*function, false);
  const uint32_t base = functions_.push_parameters(*function);
  stack_.push(code, base, scope, FrameKind::kDynamicDefaults);
}

void DynamicCalls::next_argument(const DynamicCall& site) {
  Value& state = stack_.slot(site.slot + kDone);
  const auto done = static_cast<uint32_t>(state.number());
  uint32_t argument = done;
  if (FunctionEntry* const function = function_of(site)) {
    const ArgumentPlan& plan = plan_of(site, *function);
    const bool warns_last = compiler_.dialect().has_arguments_first;
    if (done == (warns_last ? plan.steps.size() : 0)) {
      for (const ArgumentWarning& warning : plan.warnings)
        stack_.messages().warn(warning.text, warning.place, PathBase::kUnit);
    }
    if (done == plan.steps.size()) return;
    argument = plan.steps[done].argument;
  } else if (done == site.arguments.size()) {
    return;
  }
  state = done + 1.0;
  stack_.jump(site.argument_code[argument]);
}

void DynamicCalls::call(const DynamicCall& site) {
  if (FunctionEntry* const function = function_of(site)) {
    call_function(site, *function);
  } else {
    call_builtin(site);
  }
}

void DynamicCalls::call_builtin(const DynamicCall& site) {
  ValueStack& values = stack_.values;
  values.drop();
  const FunctionShape& shape = compiler_.builtins().functions.at(site.name);
  uint32_t count = static_cast<uint32_t>(site.arguments.size());
  names_.clear();
  if (shape.parameters.empty()) {
    for (const Argument& argument : site.arguments)
      names_.push_back(argument.name == kNoName ? std::string_view()
                                                : compiler_.names().text(argument.name));
  } else {
    count = assign_arguments(site, shape);
  }
  functions_.call_builtin(*site.builtin, count, names_);
  Value value = values.pop();
  stack_.dynamic.undo(static_cast<uint32_t>(stack_.slot(site.slot + kMark).number()));
  values.drop_to(stack_.base() + site.slot);
  values.push(std::move(value));
}

/// Pushes what the arguments of a call give to the parameters of a builtin function. Returns how
/// many there are.
uint32_t DynamicCalls::assign_arguments(const DynamicCall& site, const FunctionShape& shape) {
  const auto count = static_cast<uint32_t>(shape.parameters.size());
  const ArgumentPlan plan =
      compiler_.plan_builtin(shape.parameters, count, site.arguments, stack_.place());
  for (const ArgumentWarning& warning : plan.warnings)
    stack_.messages().warn(warning.text, warning.place, PathBase::kUnit);
  parameters_.assign(count, Value::unset());
  for (const ArgumentPlan::Step& step : plan.steps) {
    if (step.is_for(count))
      parameters_[step.target.slot] = stack_.slot(site.slot + kArguments + step.argument);
  }
  stack_.values.reserve(stack_.values.size() + count);
  for (Value& parameter : parameters_) stack_.values.push(std::move(parameter));
  return count;
}

void DynamicCalls::call_function(const DynamicCall& site, FunctionEntry& function) {
  const Place call = stack_.place();
  if (!site.is_tail && stack_.nests_too_deeply()) {
    stack_.fail_recursion(
        "function", site.name == kNoName ? stack_.text_of(*site.callee) : stack_.text_of(site.name),
        call);
  }
  ValueStack& values = stack_.values;
  const uint32_t base = stack_.base() + site.slot;
  const bool is_closure = values[base].is_function();
  HeapScope* const scope = is_closure
                               ? HeapScopes::acquire(closure_of(values[base]).scope)
                               : stack_.take_scope_around(site.is_in_unit, site.function_scope);
  const Code& code = compiler_.code_of(function);  // which may find more slots
  const Value& defaults = values.top();
  if (defaults.is_set()) {
    parameters_.assign(defaults.elements().begin(), defaults.elements().end());
  } else {
    parameters_ = function.initial;
  }
  parameters_.resize(code.slots, Value::unset());
  if (const Value* const object = object_of(site)) {
    const uint32_t slot = function.parameters.slot_names.find(compiler_.known().this_);
    if (slot < function.parameters.declared_slots) parameters_[slot] = *object;
  }
  for (const ArgumentPlan::Step& step : plan_of(site, function).steps) {
    if (!step.target.is_dynamic && !step.is_dropped)
      parameters_[step.target.slot] = std::move(values[base + kArguments + step.argument]);
  }
  const auto mark = static_cast<uint32_t>(values[base + kMark].number());
  values.drop_to(base);
  values.reserve(base + static_cast<uint32_t>(parameters_.size()));
  for (Value& parameter : parameters_) values.push(std::move(parameter));
  if (site.is_tail) {
    functions_.check_rounds();
    stack_.replace(code, static_cast<uint32_t>(parameters_.size()), scope);
  } else {
    stack_.push(code, base, scope, FrameKind::kFunction);
    stack_.frame().trail = mark;
  }
  Frame& frame = stack_.frame();
  frame.callee = &function;
  frame.call = call;
  frame.called_as = is_closure ? site.name : kNoName;
}

}  // namespace language
