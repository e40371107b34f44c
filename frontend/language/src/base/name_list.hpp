// Lists of names, and where names stand in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "base/name_table.hpp"

namespace language {

/// Finds names in a list that grows at its end: by a search, and by a hash once it is long.
class NameIndex {
 public:
  static constexpr uint32_t kNone = 0xFFFFFFFFu;

  /// Returns the last position of a name, or kNone. The list has `size` names, name_at(0) and so
  /// on, of which those of earlier calls have not changed.
  template <typename NameAt>
  uint32_t find(Name name, size_t size, NameAt name_at) {
    constexpr size_t kFew = 12;  // up to which a search is as fast as a hash
    if (size > kFew) return find_hashed(name, static_cast<uint32_t>(size), name_at);
    for (auto i = static_cast<uint32_t>(size); i-- > 0;)
      if (name_at(i) == name) return i;
    return kNone;
  }

 private:
  template <typename NameAt>
  uint32_t find_hashed(Name name, uint32_t size, NameAt name_at) {
    if (!positions_) positions_ = std::make_unique<std::unordered_map<Name, uint32_t>>();
    for (; indexed_ < size; ++indexed_) (*positions_)[name_at(indexed_)] = indexed_;
    const auto found = positions_->find(name);
    return found == positions_->end() ? kNone : found->second;
  }

  std::unique_ptr<std::unordered_map<Name, uint32_t>> positions_;  // of a long list
  uint32_t indexed_ = 0;                                           // names that they know
};

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
