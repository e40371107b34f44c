// Variables, scopes and `$` names.
#include "evaluation/machine.hpp"

namespace language {

HeapScope* Machine::scope_at(uint32_t number) const {
  HeapScope* scope = scope_;
  for (; number; --number) scope = scope->parent;
  return scope;
}

HeapScope* Machine::take_scope(const CallSite& site) {
  if (!site.is_in_unit) return HeapScopes::acquire(scope_at(site.scope));
  HeapScope* const scope = unit_scopes_.back();
  unit_scopes_.pop_back();
  return scope;
}

void Machine::push_dynamic(Name name, bool silently) {
  const Value& value = dynamic_[name];
  if (!records_.empty()) note_read(name);
  if (value.is_set()) return stack_.push_copy(value);
  if (!silently) return unknown_variable(name);
  stack_.push(Value::undef());
}

void Machine::unknown_variable(Name name) {
  const bool is_special = compiler_.names().is_dynamic(name);
  const bool is_child_count = name == compiler_.known().child_count;
  warn("Ignoring unknown variable '" + std::string(compiler_.names().text(name)) + "'",
       is_special && !is_child_count ? PathBase::kUnit : PathBase::kMainFile);
  stack_.push(Value::undef());
}

void Machine::push_scope(uint32_t size) { scope_ = scopes_.make(scope_, size); }

void Machine::pop_scope() {
  HeapScope* const scope = scope_;
  scope_ = HeapScopes::acquire(scope->parent);
  leave_scope(scope);
}

// With the flag, a value that is not set leaves the variable as it is.
void Machine::store_scoped(const Instruction& step) {
  Value value = stack_.pop();
  if (step.flag && !value.is_set()) return;
  scope_at(step.a)->values()[step.b] = std::move(value);
}

}  // namespace language
