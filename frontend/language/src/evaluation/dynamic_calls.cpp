// Calls whose callee is known when they happen. The slots are: the callee, the number of arguments
// that are done, the trail's mark, the arguments in their order, the evaluated defaults.
#include "evaluation/machine.hpp"
#include "language/make.hpp"
#include "syntax/syntax.hpp"

namespace language {
namespace {

constexpr uint32_t kDone = 1, kMark = 2, kArguments = 3;  // slots, counted from the callee

}  // namespace

FunctionEntry* Machine::function_of(const DynamicCall& site) {
  const Value& callee = stack_[base_ + site.slot];
  return callee.is_function() ? &closure_of(callee).function : site.function;
}

const ArgumentPlan& Machine::plan_of(const DynamicCall& site, FunctionEntry& function) {
  const auto found = site.plans.find(&function);
  if (found != site.plans.end()) return found->second;
  return site.plans.emplace(&function, compiler_.plan(function, site.arguments, place()))
      .first->second;
}

void Machine::give_up_call(const DynamicCall& site) {
  stack_.top() = Value::undef();
  next_ = site.end;
}

// Says why the value on top cannot be called, if so.
bool Machine::refuse_callee(const DynamicCall& site) {
  const Value& callee = stack_.top();
  if (site.name == kNoName) {
    if (callee.is_function()) return false;
    warn("Can't call function on " + std::string(type_name(callee.type())), PathBase::kUnit);
    return true;
  }
  if (callee.is_function() && is_dynamic_name(site.name, compiler_.names())) {
    warn("Can't call function on dynamically scoped variable", PathBase::kUnit);
    return true;
  }
  if (callee.is_function() || site.function) return false;
  if (!site.builtin) {
    warn("Ignoring unknown function '" + std::string(compiler_.names().text(site.name)) + "'",
         PathBase::kMainFile);
    return true;
  }
  const BuiltinFunction& builtin = builtin_functions_[*site.builtin];
  const size_t count = site.arguments.size();
  if (count >= builtin.least_arguments && count <= builtin.most_arguments) return false;
  warn(std::string(builtin.name) + "() number of parameters does not match", PathBase::kMainFile);
  return true;
}

HeapScope* Machine::scope_of(const DynamicCall& site) {
  const Value& callee = stack_[base_ + site.slot];
  if (callee.is_function()) return closure_of(callee).scope;
  return site.is_in_unit ? unit_scopes_.back() : scope_at(site.function_scope);
}

void Machine::prepare_call(const DynamicCall& site) {
  if (refuse_callee(site)) return give_up_call(site);
  stack_.push(0.0);
  stack_.push(static_cast<double>(dynamic_.trail()));
  for (size_t slot = 0; slot <= site.arguments.size(); ++slot) stack_.push(Value::unset());
  FunctionEntry* const function = function_of(site);
  if (!function) return;
  compiler_.prepare(*function);
  if (!function->has_default_code) return;
  HeapScope* const scope = HeapScopes::acquire(scope_of(site));
  const Code& code = compiler_.defaults_of(*function, false);
  const uint32_t base = push_parameters(*function);
  push_frame(code, base, scope, FrameKind::kDynamicDefaults, kNoActivation);
}

void Machine::keep_defaults(uint32_t base) {
  Value defaults = language::make_vector(stack_.size() - base);
  for (uint32_t slot = base; slot < stack_.size(); ++slot)
    append_element(defaults, std::move(stack_[slot]));
  stack_.drop_to(base);
  stack_.top() = std::move(defaults);
}

void Machine::next_argument(const DynamicCall& site) {
  const uint32_t state = base_ + site.slot + kDone;
  const auto done = static_cast<uint32_t>(stack_[state].number());
  uint32_t argument = done;
  if (FunctionEntry* const function = function_of(site)) {
    const ArgumentPlan& plan = plan_of(site, *function);
    if (done == 0) {
      for (const ArgumentWarning& warning : plan.warnings)
        messages_.warn(warning.text, warning.place, PathBase::kUnit);
    }
    if (done == plan.steps.size()) return;
    argument = plan.steps[done].argument;
  } else if (done == site.arguments.size()) {
    return;
  }
  stack_[state] = done + 1.0;
  next_ = site.argument_code[argument];
}

void Machine::call_dynamic(const DynamicCall& site) {
  if (FunctionEntry* const function = function_of(site))
    return call_dynamic_function(site, *function);
  const uint32_t base = base_ + site.slot;
  stack_.drop();
  call_builtin(*site.builtin, static_cast<uint32_t>(site.arguments.size()));
  Value value = stack_.pop();
  dynamic_.undo(static_cast<uint32_t>(stack_[base + kMark].number()));
  stack_.drop_to(base);
  stack_.push(std::move(value));
}

void Machine::call_dynamic_function(const DynamicCall& site, FunctionEntry& function) {
  const uint32_t base = base_ + site.slot;
  if (nests_too_deeply()) recursion_in_callee(site);
  HeapScope* const scope = HeapScopes::acquire(scope_of(site));
  const bool is_closure = stack_[base].is_function();
  if (!is_closure && site.is_in_unit) {
    HeapScopes::release(unit_scopes_.back());
    unit_scopes_.pop_back();
  }
  const Code& code = compiler_.code_of(function);  // which may find more slots
  const Value& defaults = stack_.top();
  if (defaults.is_set()) {
    parameters_.assign(defaults.elements().begin(), defaults.elements().end());
  } else {
    parameters_ = function.initial;
  }
  parameters_.resize(code.slots, Value::unset());
  for (const ArgumentPlan::Step& step : plan_of(site, function).steps) {
    if (!step.target.is_dynamic)
      parameters_[step.target.slot] = std::move(stack_[base + kArguments + step.argument]);
  }
  const auto mark = static_cast<uint32_t>(stack_[base + kMark].number());
  const Place call = place();
  stack_.drop_to(base);
  stack_.reserve(base + static_cast<uint32_t>(parameters_.size()));
  for (Value& parameter : parameters_) stack_.push(std::move(parameter));
  push_frame(code, base, scope, FrameKind::kFunction, kNoActivation);
  Frame& frame = frames_.back();
  frame.function = &function;
  frame.trail = mark;
  frame.call = call;
  if (is_closure) frame.called_as = site.name;
}

void Machine::recursion_in_callee(const DynamicCall& site) {
  if (site.name != kNoName) recursion_in_function(compiler_.names().text(site.name), place());
  recursion_in_function(callee_text(*site.callee), place());
}

}  // namespace language
