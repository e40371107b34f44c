#include "arrangement/drawn_segments.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace csgcore {
namespace {

/// A segment along its line, from the lower coordinate to the higher one.
struct SegmentExtent {
  double low;
  double high;
  uint32_t first;
  uint32_t last;
  size_t number;  // of the segment

  /// Makes it the union of both if they surely overlap, and if each end of the union surely is one
  /// of theirs, though coordinates are rounded. Returns whether it has. `next` does not begin
  /// before this one.
  bool take(const SegmentExtent& next) {
    constexpr double kApart = 1;  // far more than kPointError
    const bool begins_here = next.first == first || next.low - low > kApart;
    const bool overlaps = high - next.low > kApart;
    const bool has_an_end = next.last == last || std::abs(next.high - high) > kApart;
    if (!begins_here || !overlaps || !has_an_end) return false;
    if (next.high > high) std::tie(high, last) = std::tie(next.high, next.last);
    return true;
  }
};

/// Returns the segments of one line in their order along the axis that sees it best.
std::vector<SegmentExtent> sorted_extents(const std::vector<ArrangedPoint>& points,
                                          const std::vector<DrawnSegment>& segments,
                                          std::span<const size_t> numbers) {
  Vec3 reach(0.0);
  for (const size_t number : numbers) {
    const auto& [line, met, from, to] = segments[number];
    reach = glm::max(reach, glm::abs(points[to].position - points[from].position));
  }
  const int axis = reach.x >= reach.y && reach.x >= reach.z ? 0 : reach.y >= reach.z ? 1 : 2;
  std::vector<SegmentExtent> result;
  for (const size_t number : numbers) {
    const auto& [line, met, from, to] = segments[number];
    SegmentExtent extent{points[from].position[axis], points[to].position[axis], from, to, number};
    if (extent.high < extent.low) {
      std::swap(extent.low, extent.high);
      std::swap(extent.first, extent.last);
    }
    result.push_back(extent);
  }
  std::ranges::sort(result, {}, [](const SegmentExtent& extent) {
    return std::tuple(extent.low, extent.high, extent.number);
  });
  return result;
}

}  // namespace

void join_overlaps(const std::vector<ArrangedPoint>& points, std::vector<DrawnSegment>& segments) {
  std::vector<size_t> order(segments.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, {}, [&](size_t i) { return std::pair(segments[i].line, i); });
  std::vector<bool> is_joined(segments.size(), false);
  for (auto begin = order.begin(); begin != order.end();) {
    const auto end = std::find_if(
        begin, order.end(), [&](size_t i) { return segments[i].line != segments[*begin].line; });
    std::optional<SegmentExtent> open;
    for (const SegmentExtent& next : sorted_extents(points, segments, {begin, end})) {
      if (!open || !open->take(next)) {
        open = next;
        continue;
      }
      DrawnSegment& all = segments[open->number];
      all.from = open->first;
      all.to = open->last;
      if (all.met != segments[next.number].met) all.met = kNoPlace;
      is_joined[next.number] = true;
    }
    begin = end;
  }
  size_t kept = 0;
  for (size_t i = 0; i < segments.size(); ++i) {
    if (!is_joined[i]) segments[kept++] = segments[i];
  }
  segments.resize(kept);
}

}  // namespace csgcore
