#include "code/scope_layout.hpp"

namespace language {

ScopeVariable& ScopeLayout::add(Name name, uint32_t slot) {
  variables_.push_back({name, slot});
  return variables_.back();
}

ScopeVariable& ScopeLayout::declare(Name name) {
  if (ScopeVariable* found = find(name)) return *found;
  return add(name, size());
}

const ScopeVariable* ScopeLayout::find(Name name) const {
  const uint32_t position =
      index_.find(name, variables_.size(), [&](uint32_t i) { return variables_[i].name; });
  return position == NameIndex::kNone ? nullptr : &variables_[position];
}

ScopeVariable* ScopeLayout::find(Name name) {
  return const_cast<ScopeVariable*>(static_cast<const ScopeLayout*>(this)->find(name));
}

}  // namespace language
