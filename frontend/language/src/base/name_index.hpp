// Where names stand in a list.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>

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

}  // namespace language
