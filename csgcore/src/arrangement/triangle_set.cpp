#include "csgcore/triangle_set.hpp"

#include <algorithm>
#include <utility>

namespace csgcore {

size_t open_edges(const TriangleSet& surface) {
  std::vector<std::pair<uint64_t, int>> edges;
  for (const auto& triangle : surface.triangles) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = triangle[i];
      const uint32_t b = triangle[(i + 1) % 3];
      edges.emplace_back(uint64_t{std::min(a, b)} << 32 | std::max(a, b), a < b ? 1 : -1);
    }
  }
  std::ranges::sort(edges);
  size_t result = 0;
  for (size_t i = 0; i < edges.size();) {
    const uint64_t edge = edges[i].first;
    int sum = 0;
    for (; i < edges.size() && edges[i].first == edge; ++i) sum += edges[i].second;
    if (sum != 0) ++result;
  }
  return result;
}

}  // namespace csgcore
