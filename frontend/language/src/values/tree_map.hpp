// New vectors from nested ones, without recursion, however deeply they nest.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

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
  std::vector<Level> levels;
  levels.emplace_back(vector);
  while (true) {
    Level& level = levels.back();
    if (level.rest.empty()) {
      Value result = std::move(level.result);
      levels.pop_back();
      if (levels.empty()) return result;
      append_element(levels.back().result, std::move(result));
      continue;
    }
    const Value& element = level.rest.front();
    level.rest = level.rest.subspan(1);
    if (element.is_vector())
      levels.emplace_back(element);
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
  std::vector<Level> levels;
  levels.emplace_back(left, right);
  while (true) {
    Level& level = levels.back();
    if (level.next == level.end) {
      Value result = std::move(level.result);
      levels.pop_back();
      if (levels.empty()) return result;
      append_element(levels.back().result, std::move(result));
      continue;
    }
    const Value &a = level.left[level.next], &b = level.right[level.next];
    ++level.next;
    if (a.is_vector() && b.is_vector())
      levels.emplace_back(a, b);
    else
      append_element(level.result, leaf(a, b));
  }
}

}  // namespace language
