// The `$` names: each has one current value, and a trail of what was bound before.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/name_table.hpp"
#include "language/value.hpp"

namespace language {

/// `$` names with their values; unset: not bound.
using NamedValues = std::vector<std::pair<Name, Value>>;

class DynamicNames {
 public:
  explicit DynamicNames(size_t names) : values_(names, Value::unset()) {}

  /// Unset: the name has no value.
  const Value& operator[](Name name) const { return values_[name]; }
  void bind(Name name, Value value) {
    trail_.push_back({name, std::move(values_[name])});
    values_[name] = std::move(value);
  }
  uint32_t trail() const { return static_cast<uint32_t>(trail_.size()); }
  void undo(uint32_t trail) {
    while (trail_.size() > trail) {
      values_[trail_.back().name] = std::move(trail_.back().value);
      trail_.pop_back();
    }
  }
  /// Returns whether a name was bound after the trail had a length.
  bool is_bound_since(Name name, uint32_t trail) const {
    return is_bound_between(name, trail, this->trail());
  }
  /// Returns whether it was bound after that, before the trail had a greater length.
  bool is_bound_between(Name name, uint32_t from, uint32_t to) const {
    for (size_t entry = from; entry < to; ++entry)
      if (trail_[entry].name == name) return true;
    return false;
  }
  /// Returns the value that a name had when the trail had a length.
  const Value& value_at(Name name, uint32_t trail) const {
    for (size_t entry = trail; entry < trail_.size(); ++entry)
      if (trail_[entry].name == name) return trail_[entry].value;
    return values_[name];
  }
  /// Returns the names that were bound since, in order.
  std::vector<Name> bound_since(uint32_t trail) const {
    std::vector<Name> names;
    for (size_t entry = trail; entry < trail_.size(); ++entry) names.push_back(trail_[entry].name);
    return names;
  }

 private:
  struct Bound {
    Name name;
    Value value;  // before
  };
  std::vector<Value> values_;
  std::vector<Bound> trail_;
};

}  // namespace language
