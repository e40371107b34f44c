// Names in the order in which they were added, each once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/name_index.hpp"

namespace language {

class NameList {
 public:
  static constexpr uint32_t kNone = NameIndex::kNone;

  /// Returns a name's position; kNone: it was not added.
  uint32_t find(Name name) const {
    return index_.find(name, names_.size(), [&](uint32_t i) { return names_[i]; });
  }
  /// Adds a name unless it is there. Returns its position.
  uint32_t add(Name name) {
    const uint32_t position = find(name);
    if (position != kNone) return position;
    names_.push_back(name);
    return static_cast<uint32_t>(names_.size() - 1);
  }
  size_t size() const { return names_.size(); }
  Name operator[](size_t position) const { return names_[position]; }
  auto begin() const { return names_.begin(); }
  auto end() const { return names_.end(); }

 private:
  std::vector<Name> names_;
  mutable NameIndex index_;
};

}  // namespace language
