#include "evaluation/top_levels.hpp"

#include <algorithm>
#include <new>
#include <string>

#include "values/copies.hpp"

namespace language {
namespace {

NamedValues copies_of(const NamedValues& values, ValueCopier& copier) {
  NamedValues copies;
  for (const auto& [name, value] : values) copies.emplace_back(name, copier.copy(value));
  return copies;
}

/// Returns whether each copy of a set value is set.
bool are_copied(const NamedValues& values, const NamedValues& copies) {
  for (size_t i = 0; i < values.size(); ++i)
    if (values[i].second.is_set() && !copies[i].second.is_set()) return false;
  return true;
}

}  // namespace

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
  kept.is_loaded = false;
  kept.reads = stack_.recorder.reads();
  kept.bindings.clear();
  for (const Name name : stack_.dynamic.bound_since(record.trail))
    kept.bindings.emplace_back(name, stack_.dynamic[name]);
}

bool TopLevels::reuse(uint32_t unit) {
  const Kept& kept = kept_[unit];
  if (earlier_ && !kept.is_looked_up) load(unit);
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

const std::string& TopLevels::path_of(uint32_t unit) const {
  const Program& program = compiler_.program();
  return program.files[program.units[unit].file].path;
}

/// Takes over what an earlier evaluation has kept of a unit's top level.
void TopLevels::load(uint32_t unit) {
  Kept& kept = kept_[unit];
  kept.is_looked_up = true;
  const auto found = earlier_->find(path_of(unit));
  if (found == earlier_->end()) return;
  const KeptTop& top = found->second;
  if (top.identity != unit_identity(compiler_.program(), unit)) return;
  // Half a copy, where there is no memory for all, may not be kept.
  ValueCopier copier;
  HeapScope* const scope = stack_.scopes.make(nullptr, static_cast<uint32_t>(top.variables.size()));
  for (size_t slot = 0; slot < top.variables.size(); ++slot)
    scope->values()[slot] = copier.copy(top.variables[slot]);
  NamedValues reads = copies_of(top.reads, copier), bindings = copies_of(top.bindings, copier);
  kept = {scope, std::move(reads), std::move(bindings), true, true};
}

void TopLevels::save(uint32_t unit, KeptTops& tops) {
  const Kept& kept = kept_[unit];
  if (kept.is_loaded) return;
  bool is_whole = kept.scope;
  KeptTop top{unit_identity(compiler_.program(), unit), {}, {}, {}};
  ValueCopier copier;
  for (uint32_t slot = 0; is_whole && slot < kept.scope->size; ++slot) {
    const Value& value = kept.scope->values()[slot];
    top.variables.push_back(copier.copy(value));
    is_whole = !value.is_set() || top.variables.back().is_set();
  }
  top.reads = copies_of(kept.reads, copier);
  top.bindings = copies_of(kept.bindings, copier);
  is_whole =
      is_whole && are_copied(kept.reads, top.reads) && are_copied(kept.bindings, top.bindings);
  if (is_whole) {
    tops[path_of(unit)] = std::move(top);
  } else {
    tops.erase(path_of(unit));
  }
}

void TopLevels::save(KeptTops& tops) {
  try {
    for (uint32_t unit = 1; unit < kept_.size(); ++unit)
      if (kept_[unit].is_looked_up) save(unit, tops);
  } catch (const std::bad_alloc&) {
    tops.clear();
  }
}

}  // namespace language
