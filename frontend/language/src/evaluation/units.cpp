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
  begin_record(unit);
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
  keep_unit(records_.back(), scope);
  end_record();
  unit_scopes_.push_back(scope);
  return false;
}

void Machine::keep_unit(const Record& record, HeapScope* scope) {
  if (!record.is_pure || !has_said_nothing(record)) return note_history();
  KeptUnit& kept = kept_units_[record.unit];
  HeapScopes::release(kept.scope);
  kept.scope = HeapScopes::acquire(scope);
  kept.is_loaded = false;
  kept.reads = noted_reads(record);
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

}  // namespace language
