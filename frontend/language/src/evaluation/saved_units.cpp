// Takes top levels of used files over from earlier evaluations, and keeps them for later ones.
#include "evaluation/machine.hpp"
#include "values/copies.hpp"
#include "values/object_memory.hpp"

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

/// Takes over what an earlier evaluation has kept of a unit's top level.
void Machine::load_unit(uint32_t unit) {
  KeptUnit& kept = kept_units_[unit];
  kept.is_looked_up = true;
  const Program& program = compiler_.program();
  const auto found = kept_tops_->find(program.files[program.units[unit].file].path);
  if (found == kept_tops_->end()) return;
  const KeptTop& top = found->second;
  if (top.identity != unit_identity(program, unit)) return;
  // Half a copy, where there is no memory for all, may not be kept.
  ValueCopier copier;
  HeapScope* const scope = scopes_.make(nullptr, static_cast<uint32_t>(top.variables.size()));
  for (size_t slot = 0; slot < top.variables.size(); ++slot)
    scope->values()[slot] = copier.copy(top.variables[slot]);
  NamedValues reads = copies_of(top.reads, copier), bindings = copies_of(top.bindings, copier);
  kept = {scope, std::move(reads), std::move(bindings), true, true};
}

void Machine::save_unit(uint32_t unit, KeptTops& tops) {
  const KeptUnit& kept = kept_units_[unit];
  const Program& program = compiler_.program();
  const std::string& path = program.files[program.units[unit].file].path;
  if (!kept.scope) {
    tops.erase(path);
    return;
  }
  if (kept.is_loaded) return;
  KeptTop top{unit_identity(program, unit), {}, {}, {}};
  ValueCopier copier;
  bool is_whole = true;
  for (uint32_t slot = 0; slot < kept.scope->size; ++slot) {
    const Value& value = kept.scope->values()[slot];
    top.variables.push_back(copier.copy(value));
    is_whole = is_whole && (!value.is_set() || top.variables.back().is_set());
  }
  top.reads = copies_of(kept.reads, copier);
  top.bindings = copies_of(kept.bindings, copier);
  is_whole =
      is_whole && are_copied(kept.reads, top.reads) && are_copied(kept.bindings, top.bindings);
  if (is_whole) {
    tops[path] = std::move(top);
  } else {
    tops.erase(path);
  }
}

void Machine::save_units(KeptTops& tops) {
  try {
    for (uint32_t unit = 1; unit < kept_units_.size(); ++unit)
      if (kept_units_[unit].is_looked_up) save_unit(unit, tops);
  } catch (const std::bad_alloc&) {
    tops.clear();
  }
}

}  // namespace language
