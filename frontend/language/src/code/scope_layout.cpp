#include "code/scope_layout.hpp"

namespace language {
namespace {

constexpr size_t kLinearSearchLimit = 12;  // up to which a search is as fast as a hash table

}  // namespace

ScopeVariable& ScopeLayout::add(Name name, uint32_t slot) {
  variables_.push_back({name, slot});
  if (variables_.size() > kLinearSearchLimit) {
    for (auto number = static_cast<uint32_t>(index_.size()); number < variables_.size(); ++number)
      index_[variables_[number].name] = number;
  }
  return variables_.back();
}

ScopeVariable& ScopeLayout::declare(Name name) {
  if (ScopeVariable* found = find(name)) return *found;
  return add(name, size());
}

const ScopeVariable* ScopeLayout::find(Name name) const {
  if (variables_.size() > kLinearSearchLimit) {
    const auto found = index_.find(name);
    return found == index_.end() ? nullptr : &variables_[found->second];
  }
  for (auto variable = variables_.rbegin(); variable != variables_.rend(); ++variable)
    if (variable->name == name) return &*variable;
  return nullptr;
}

ScopeVariable* ScopeLayout::find(Name name) {
  return const_cast<ScopeVariable*>(static_cast<const ScopeLayout*>(this)->find(name));
}

}  // namespace language
