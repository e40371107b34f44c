// Lists of syntax nodes that grow while their arena gets other nodes.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "syntax/arena.hpp"

namespace language {

/// Copies something to an arena. It needs no destruction.
template <typename T>
T* copy_to_arena(Arena& arena, const T& value) {
  return new (arena.allocate(sizeof(T), alignof(T))) T(value);
}

/// Copies elements to an arena. They need no destruction.
template <typename T>
std::span<const T> copy_to_arena(Arena& arena, std::span<const T> elements) {
  if (elements.empty()) return {};
  auto* copy = static_cast<T*>(arena.allocate(elements.size_bytes(), alignof(T)));
  std::uninitialized_copy(elements.begin(), elements.end(), copy);
  return {copy, elements.size()};
}

/// The list being made, on top of those that enclose it: all of one type share a vector, so that
/// short lists cost no allocation. Lists must end in the reverse order of their beginnings.
template <typename T>
class ArenaList {
 public:
  explicit ArenaList(std::vector<T>& shared) : shared_(shared), begin_(shared.size()) {}
  ArenaList(const ArenaList&) = delete;
  ArenaList& operator=(const ArenaList&) = delete;
  ~ArenaList() { shared_.resize(begin_); }

  void push(const T& element) { shared_.push_back(element); }
  size_t size() const { return shared_.size() - begin_; }
  T& operator[](size_t i) { return shared_[begin_ + i]; }
  /// Returns the elements, copied to an arena.
  std::span<const T> finish(Arena& arena) const {
    return copy_to_arena(arena, std::span<const T>(shared_).subspan(begin_));
  }

 private:
  std::vector<T>& shared_;
  size_t begin_;
};

}  // namespace language
