// Names in the order in which they were added, each once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/name_table.hpp"

namespace language {

class NameList {
 public:
  static constexpr uint32_t kNone = 0xFFFFFFFFu;

  /// Returns a name's position; kNone: it was not added.
  uint32_t find(Name name) const {
    if (names_.size() > kFew) {
      const auto found = index_.find(name);
      return found == index_.end() ? kNone : found->second;
    }
    for (uint32_t i = 0; i < names_.size(); ++i)
      if (names_[i] == name) return i;
    return kNone;
  }
  /// Adds a name unless it is there. Returns its position.
  uint32_t add(Name name) {
    const uint32_t position = find(name);
    if (position != kNone) return position;
    names_.push_back(name);
    if (names_.size() > kFew) {
      for (auto i = static_cast<uint32_t>(index_.size()); i < names_.size(); ++i)
        index_.emplace(names_[i], i);
    }
    return static_cast<uint32_t>(names_.size() - 1);
  }
  size_t size() const { return names_.size(); }
  Name operator[](size_t position) const { return names_[position]; }
  auto begin() const { return names_.begin(); }
  auto end() const { return names_.end(); }

 private:
  static constexpr size_t kFew = 12;  // up to which a search is as fast as a hash table

  std::vector<Name> names_;
  std::unordered_map<Name, uint32_t> index_;  // filled once there are more
};

}  // namespace language
