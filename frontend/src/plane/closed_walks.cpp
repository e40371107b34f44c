#include "plane/closed_walks.hpp"

#include <algorithm>
#include <cstddef>

namespace frontend {

std::vector<std::vector<uint64_t>> closed_walks(std::vector<Arc> arcs) {
  const auto less = [](const Arc& a, const Arc& b) { return a.from < b.from; };
  std::stable_sort(arcs.begin(), arcs.end(), less);
  // By the place of the first arc from somewhere: how many of those arcs are taken.
  std::vector<uint32_t> taken(arcs.size());
  const auto first_from = [&](uint64_t place) {
    return static_cast<size_t>(std::lower_bound(arcs.begin(), arcs.end(), Arc{place, 0}, less) -
                               arcs.begin());
  };
  std::vector<std::vector<uint64_t>> walks;
  for (size_t first = 0; first < arcs.size();) {
    const uint64_t start = arcs[first].from;
    const size_t next = first + taken[first];
    if (next == arcs.size() || arcs[next].from != start) {
      while (first < arcs.size() && arcs[first].from == start) ++first;
      continue;
    }
    std::vector<uint64_t>& walk = walks.emplace_back();
    for (size_t at = first;;) {
      walk.push_back(arcs[at].from);
      const uint64_t to = arcs[at + taken[at]++].to;
      if (to == start) break;
      at = first_from(to);
    }
  }
  return walks;
}

}  // namespace frontend
