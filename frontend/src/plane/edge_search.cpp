#include "plane/edge_search.hpp"

#include <numeric>

namespace frontend {

EdgeSearch::EdgeSearch(std::span<const RoofEdge> edges)
    : edges_(edges), growth_(edges.size()), order_(edges.size()) {
  if (edges.empty()) return;
  std::iota(order_.begin(), order_.end(), 0u);
  boxes_.reserve(edges.size());
  boxes_.emplace_back();
  build(0, 0, static_cast<uint32_t>(edges.size()));
}

void EdgeSearch::widen(uint32_t edge) {
  if (growth_[edge].is_wide) return;
  growth_[edge].is_wide = true;
  wide_.push_back(edge);
}

void EdgeSearch::end_growth(uint32_t edge, bool is_start, double time) {
  (is_start ? growth_[edge].start_until : growth_[edge].end_until) = time;
}

/// Divides the edges order_[begin] to order_[end − 1] by the middle one, so that the depth is the
/// logarithm of their number.
void EdgeSearch::build(uint32_t box, uint32_t begin, uint32_t end) {
  constexpr uint32_t kMostInLeaf = 4;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  SearchBox own{Vec2(kFar), Vec2(-kFar), Vec2(kFar), Vec2(-kFar), begin, end - begin};
  for (uint32_t i = begin; i < end; ++i) {
    const RoofEdge& edge = edges_[order_[i]];
    own.min = glm::min(own.min, glm::min(edge.start, edge.end));
    own.max = glm::max(own.max, glm::max(edge.start, edge.end));
    for (const double along : {-edge.start_reach, edge.end_reach}) {
      const Vec2 velocity = edge.normal() + along * edge.direction;
      own.min_velocity = glm::min(own.min_velocity, velocity);
      own.max_velocity = glm::max(own.max_velocity, velocity);
    }
  }
  if (own.count > kMostInLeaf) {
    const int axis = own.max.x - own.min.x >= own.max.y - own.min.y ? 0 : 1;
    const uint32_t middle = begin + own.count / 2;
    const auto at = [&](uint32_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](uint32_t a, uint32_t b) {
      return edges_[a].start[axis] + edges_[a].end[axis] <
             edges_[b].start[axis] + edges_[b].end[axis];
    });
    own.first = static_cast<uint32_t>(boxes_.size());
    own.count = 0;
    boxes_.emplace_back();
    boxes_.emplace_back();
    build(own.first, begin, middle);
    build(own.first + 1, middle, end);
  }
  boxes_[box] = own;
}

}  // namespace frontend
