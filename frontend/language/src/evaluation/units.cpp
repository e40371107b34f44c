// Used files: each call of one of their functions or modules has their top level evaluated anew, as
// far as that can be observed (LANGUAGE.md, "Scopes and calls").
#include <algorithm>

#include "evaluation/machine.hpp"
#include "values/copies.hpp"

namespace language {

void Machine::enter_unit(uint32_t unit) {
  if (reuse_unit(unit)) return;
  UnitEntry& entry = compiler_.unit(unit);
  if (frames_.size() >= kDepthLimit) fail("Recursion detected in a used file", place());
  records_.push_back({unit, dynamic_.trail(), messages_.said()});
  push_frame(*entry.assignments, stack_.size(), scopes_.make(nullptr, entry.scope->size()),
             FrameKind::kUnit, kNoActivation);
}

bool Machine::end_unit() {
  if (frames_.back().kind == FrameKind::kMainUnit) {
    pop_frame();
    return true;
  }
  HeapScope* const scope = HeapScopes::acquire(scope_);
  pop_frame();
  const UnitRecord record = std::move(records_.back());
  records_.pop_back();
  keep_unit(record, scope);
  unit_scopes_.push_back(scope);
  return false;
}

void Machine::keep_unit(const UnitRecord& record, HeapScope* scope) {
  if (!record.is_pure || record.messages != messages_.said()) {
    for (UnitRecord& outer : records_) outer.is_pure = false;
    return;
  }
  KeptUnit& kept = kept_units_[record.unit];
  HeapScopes::release(kept.scope);
  kept.scope = HeapScopes::acquire(scope);
  kept.is_loaded = false;
  kept.reads = record.reads;
  kept.bindings.clear();
  for (const Name name : dynamic_.bound_since(record.trail))
    kept.bindings.emplace_back(name, dynamic_[name]);
}

bool Machine::reuse_unit(uint32_t unit) {
  if (kept_tops_ && !kept_units_[unit].is_looked_up) load_unit(unit);
  const KeptUnit& kept = kept_units_[unit];
  if (!kept.scope) return false;
  const bool is_same = std::all_of(kept.reads.begin(), kept.reads.end(), [&](const auto& read) {
    return are_identical(dynamic_[read.first], read.second);
  });
  if (!is_same) return false;
  if (!records_.empty())
    for (const auto& read : kept.reads) note_read(read.first);
  for (const auto& [name, value] : kept.bindings) dynamic_.bind(name, value);
  unit_scopes_.push_back(HeapScopes::acquire(kept.scope));
  return true;
}

// What depends on what has happened before in the run.
void Machine::note_history() {
  for (UnitRecord& record : records_) record.is_pure = false;
}

// Functions whose results differ from call to call, or with a file.
void Machine::note_builtin(const BuiltinFunction& function) {
  constexpr std::string_view kSuch[] = {"rands", "parent_module", "dxf_dim", "dxf_cross"};
  if (std::find(std::begin(kSuch), std::end(kSuch), function.name) != std::end(kSuch))
    note_history();
}

}  // namespace language
