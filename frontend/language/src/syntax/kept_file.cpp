#include "syntax/kept_file.hpp"

#include <algorithm>

namespace language {

const KeptStatement* KeptFile::find(uint32_t offset) {
  const auto stands_at = [&](size_t number) {
    return number < statements_.size() &&
           (statements_[number].blank == offset || statements_[number].begin == offset);
  };
  if (statements_.empty() || statements_.back().begin < offset) return nullptr;
  if (!stands_at(next_)) {
    const auto found = std::lower_bound(
        statements_.begin(), statements_.end(), offset,
        [](const KeptStatement& statement, uint32_t wanted) { return statement.begin < wanted; });
    next_ = static_cast<size_t>(found - statements_.begin());
    if (!stands_at(next_)) return nullptr;
  }
  return &statements_[next_++];
}

}  // namespace language
