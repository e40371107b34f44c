// New vectors from nested ones, without recursion, however deeply they nest.
#pragma once

#include <algorithm>
#include <span>
#include <utility>

#include "values/level_stack.hpp"
#include "values/make.hpp"

namespace language {

/// Returns a vector of the same nesting as `vector` whose leaves are leaf(element) of the leaves:
/// of the elements that are no vectors.
template <typename Leaf>
Value map_leaves(const Value& vector, Leaf leaf) {
  struct Level {
    std::span<const Value> rest;
    Value result;
    explicit Level(const Value& source)
        : rest(source.elements()), result(make_vector(rest.size())) {}
  };
  LevelStack<Level> levels;
  levels.push(vector);
  while (true) {
    Level& level = levels.top();
    if (level.rest.empty()) {
      Value result = std::move(level.result);
      levels.pop();
      if (levels.empty()) return result;
      append_element(levels.top().result, std::move(result));
      continue;
    }
    const Value& element = level.rest.front();
    level.rest = level.rest.subspan(1);
    if (element.is_vector())
      levels.push(element);
    else
      append_element(level.result, leaf(element));
  }
}

/// Returns the vector of what becomes of each pair of elements of two vectors, as long as the
/// shorter: of two vectors again such a vector, of any others leaf(left, right).
template <typename Leaf>
Value map_pairs(const Value& left, const Value& right, Leaf leaf) {
  struct Level {
    std::span<const Value> left, right;
    size_t next = 0, end;
    Value result;
    Level(const Value& left_vector, const Value& right_vector)
        : left(left_vector.elements()),
          right(right_vector.elements()),
          end(std::min(left.size(), right.size())),
          result(make_vector(end)) {}
  };
  LevelStack<Level> levels;
  levels.push(left, right);
  while (true) {
    Level& level = levels.top();
    if (level.next == level.end) {
      Value result = std::move(level.result);
      levels.pop();
      if (levels.empty()) return result;
      append_element(levels.top().result, std::move(result));
      continue;
    }
    const Value &a = level.left[level.next], &b = level.right[level.next];
    ++level.next;
    if (a.is_vector() && b.is_vector())
      levels.push(a, b);
    else
      append_element(level.result, leaf(a, b));
  }
}

}  // namespace language
