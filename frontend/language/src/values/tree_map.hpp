// Walks through nested vectors, without recursion, however deeply they nest.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "base/evaluation_thread.hpp"
#include "language/make.hpp"
#include "values/object_memory.hpp"

namespace language {

/// A stack that takes memory from the heap only beyond a few levels.
template <typename Level>
class LevelStack {
 public:
  LevelStack() { levels_.reserve(kFewLevels); }
  LevelStack(const LevelStack&) = delete;
  LevelStack& operator=(const LevelStack&) = delete;

  template <typename... Arguments>
  void push(Arguments&&... arguments) {
    levels_.emplace_back(std::forward<Arguments>(arguments)...);
  }
  void pop() { levels_.pop_back(); }
  bool empty() const { return levels_.empty(); }
  Level& top() { return levels_.back(); }
  const std::pmr::vector<Level>& levels() const { return levels_; }

 private:
  static constexpr size_t kFewLevels = 4;

  alignas(Level) std::array<std::byte, kFewLevels * sizeof(Level)> room_;
  std::pmr::monotonic_buffer_resource memory_{room_.data(), room_.size()};
  std::pmr::vector<Level> levels_{&memory_};
};

/// Lets levels of nested vectors be filled, each of which has
///   bool fill(): appends leaves to its `result`, which has room for all elements; false: the level
///     that next() returns comes first.
/// Throws TooLarge.
template <typename Level>
Value fill_levels(Level first) {
  if (first.fill()) return std::move(first.result);
  LevelStack<Level> levels;
  levels.push(std::move(first));
  while (true) {
    if (!levels.top().fill()) {
      if (levels.levels().size() >= kMostNesting)
        throw TooLarge("Vectors nest too deeply: more than 30000 in one another");
      levels.push(levels.top().next());
      continue;
    }
    Value result = std::move(levels.top().result);
    levels.pop();
    if (levels.empty()) return result;
    append_in_room(levels.top().result, std::move(result));
  }
}

/// Returns a vector of the same nesting as `vector` whose leaves are leaf(element) of the leaves:
/// of the elements that are no vectors.
template <typename Leaf>
Value map_leaves(const Value& vector, Leaf leaf) {
  struct Level {
    std::span<const Value> rest;
    const Leaf& leaf;
    Value result;
    Level(const Value& source, const Leaf& of_leaf)
        : rest(source.elements()), leaf(of_leaf), result(make_vector(rest.size())) {}
    bool fill() {
      for (; !rest.empty() && !rest.front().is_vector(); rest = rest.subspan(1)) {
        count_work();
        append_in_room(result, leaf(rest.front()));
      }
      return rest.empty();
    }
    Level next() {
      const Value& inner = rest.front();
      rest = rest.subspan(1);
      return Level(inner, leaf);
    }
  };
  return fill_levels(Level(vector, leaf));
}

/// Returns the vector of what becomes of each pair of elements of two vectors, as long as the
/// shorter: of two vectors again such a vector, of any others leaf(left, right).
template <typename Leaf>
Value map_pairs(const Value& left_vector, const Value& right_vector, Leaf leaf) {
  struct Level {
    const Value *left, *right, *end;
    const Leaf& leaf;
    Value result;
    Level(std::span<const Value> lefts, std::span<const Value> rights, const Leaf& of_leaf)
        : left(lefts.data()),
          right(rights.data()),
          end(left + std::min(lefts.size(), rights.size())),
          leaf(of_leaf),
          result(make_vector(static_cast<size_t>(end - left))) {}
    bool fill() {
      for (; left != end && !(left->is_vector() && right->is_vector()); ++left, ++right) {
        count_work();
        append_in_room(result, leaf(*left, *right));
      }
      return left == end;
    }
    Level next() { return Level(left++->elements(), right++->elements(), leaf); }
  };
  return fill_levels(Level(left_vector.elements(), right_vector.elements(), leaf));
}

}  // namespace language
