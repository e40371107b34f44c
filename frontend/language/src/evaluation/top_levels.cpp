#include "evaluation/top_levels.hpp"

#include <algorithm>

#include "values/operators.hpp"

namespace language {

void TopLevels::begin_main() {
  UnitEntry& main = compiler_.unit(0);
  main_scope_ = stack_.scopes.make(nullptr, main.scope->size());
  stack_.push(*main.assignments, HeapScopes::acquire(main_scope_), FrameKind::kMainUnit);
}

void TopLevels::enter(uint32_t unit) {
  if (reuse(unit)) return;
  UnitEntry& entry = compiler_.unit(unit);
  if (stack_.depth() >= kDepthLimit)
    stack_.fail("Recursion detected in a used file", stack_.place());
  stack_.recorder.begin(unit);
  stack_.push(*entry.assignments, stack_.scopes.make(nullptr, entry.scope->size()),
              FrameKind::kUnit);
}

bool TopLevels::end() {
  if (stack_.frame().kind == FrameKind::kMainUnit) {
    stack_.pop();
    return true;
  }
  HeapScope* const scope = HeapScopes::acquire(stack_.scope());
  stack_.pop();
  keep(scope);
  stack_.recorder.end();
  stack_.keep_unit_scope(scope);
  return false;
}

void TopLevels::keep(HeapScope* scope) {
  if (!stack_.recorder.is_repeatable()) return stack_.recorder.note_history();
  const Record& record = stack_.recorder.innermost();
  Kept& kept = kept_[record.unit];
  HeapScopes::release(kept.scope);
  kept.scope = HeapScopes::acquire(scope);
  kept.reads = stack_.recorder.reads();
  kept.bindings.clear();
  for (const Name name : stack_.dynamic.bound_since(record.trail))
    kept.bindings.emplace_back(name, stack_.dynamic[name]);
}

bool TopLevels::reuse(uint32_t unit) {
  const Kept& kept = kept_[unit];
  if (!kept.scope) return false;
  const bool is_same = std::all_of(kept.reads.begin(), kept.reads.end(), [&](const auto& read) {
    return are_identical(stack_.dynamic[read.first], read.second);
  });
  if (!is_same) return false;
  for (const auto& read : kept.reads) stack_.recorder.note_read(read.first);
  for (const auto& [name, value] : kept.bindings) stack_.dynamic.bind(name, value);
  stack_.keep_unit_scope(HeapScopes::acquire(kept.scope));
  return true;
}

}  // namespace language
