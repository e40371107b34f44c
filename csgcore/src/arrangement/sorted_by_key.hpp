// Sorting by small numbers, as those of the points in which edges start.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace csgcore {

/// Sorts items by key(item), which is less than `keys`, and those of one key as operator< says: in
/// linear time where few have the same.
template <class Item, class Key>
void sort_by_key(std::vector<Item>& items, size_t keys, Key key) {
  std::vector<uint32_t> ends(keys + 1, 0);
  for (const Item& item : items) ++ends[key(item) + 1];
  for (size_t i = 1; i <= keys; ++i) ends[i] += ends[i - 1];
  std::vector<Item> sorted(items.size());
  for (const Item& item : items) sorted[ends[key(item)]++] = item;
  items = std::move(sorted);
  constexpr size_t kAtOnce = 16'384;
  tbb::parallel_for(tbb::blocked_range<size_t>(0, keys, kAtOnce), [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) {
      const auto begin = items.begin() + (i == 0 ? 0 : ends[i - 1]);
      const auto end = items.begin() + ends[i];
      if (end - begin > 1) std::sort(begin, end);
    }
  });
}

}  // namespace csgcore
