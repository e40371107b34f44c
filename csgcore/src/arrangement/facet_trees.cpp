#include "arrangement/facet_trees.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>
#include <utility>

#include "csgcore/stop_scope.hpp"

namespace csgcore {
namespace {

/// Half an ulp and more below what float makes of the number.
float rounded_down(int64_t x) {
  const auto result = static_cast<float>(x);
  return result - std::abs(result) * 0x1p-23f;
}

FacetBox box_around(const std::array<GridPoint, 3>& corners) {
  GridPoint least;
  GridPoint most;
  for (size_t i = 0; i < 3; ++i) {
    std::tie(least[i], most[i]) = std::minmax({corners[0][i], corners[1][i], corners[2][i]});
  }
  return box_between(least, most);
}

}  // namespace

FacetBox box_between(const GridPoint& least, const GridPoint& most) {
  FacetBox box;
  for (size_t i = 0; i < 3; ++i) {
    box.min[i] = rounded_down(least[i]);
    box.max[i] = -rounded_down(-most[i]);
  }
  return box;
}

/// Spreads the lowest 20 bits: two zeros come after each.
uint64_t spread(uint64_t bits) {
  bits = (bits | bits << 32) & 0x001f00000000ffffu;
  bits = (bits | bits << 16) & 0x001f0000ff0000ffu;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
  return (bits | bits << 2) & 0x1249249249249249u;
}

class BoxTree::Builder {
 public:
  explicit Builder(std::span<const FacetBox> boxes) : boxes_(boxes), items_(boxes.size()) {
    FacetBox all = boxes.front();
    for (const FacetBox& box : boxes) all.merge(box);
    float longest = 0;
    for (size_t i = 0; i < 3; ++i) longest = std::max(longest, all.max[i] - all.min[i]);
    // The doubled centres get 20 bits along each axis.
    const float scale = longest > 0 ? 0x1p19f / longest : 0.0f;
    for (uint32_t i = 0; i < items_.size(); ++i) {
      items_[i] = {0, i};
      for (size_t j = 0; j < 3; ++j) {
        const float center = (boxes[i].min[j] - all.min[j]) + (boxes[i].max[j] - all.min[j]);
        items_[i].code |= spread(static_cast<uint64_t>(center * scale)) << j;
      }
    }
    tbb::parallel_sort(items_.begin(), items_.end());
  }

  std::vector<Node> nodes() {
    std::vector<Node> result;
    result.reserve(items_.size());
    build(0, static_cast<uint32_t>(items_.size()), result);
    return result;
  }
  std::vector<uint32_t> order() const {
    std::vector<uint32_t> result;
    result.reserve(items_.size());
    for (const Item& item : items_) result.push_back(item.number);
    return result;
  }

 private:
  /// A box, and where its centre lies on Morton's curve.
  struct Item {
    uint64_t code;
    uint32_t number;
    auto operator<=>(const Item&) const = default;
  };

  /// Appends the nodes. Recurses as deep as the tree is: once a bit, and where codes are
  /// equal it is balanced.
  void build(uint32_t begin, uint32_t end, std::vector<Node>& nodes) {
    const auto number = static_cast<uint32_t>(nodes.size());
    constexpr uint32_t kFew = 8;
    if (end - begin <= kFew) {
      FacetBox box = boxes_[items_[begin].number];
      for (uint32_t i = begin; i < end; ++i) box.merge(boxes_[items_[i].number]);
      nodes.push_back({box, begin, end, number + 1});
      return;
    }
    const uint32_t middle = middle_of(begin, end);
    nodes.push_back({{}, begin, end, 0});
    const uint32_t low = number + 1;
    build(begin, middle, nodes);
    build(middle, end, nodes);
    nodes[number].after = static_cast<uint32_t>(nodes.size());
    nodes[number].box = nodes[low].box;
    nodes[number].box.merge(nodes[nodes[low].after].box);
  }

  /// Returns where the highest bit changes in which codes differ, so that the halves lie on both
  /// sides of a plane.
  uint32_t middle_of(uint32_t begin, uint32_t end) const {
    const uint64_t differing = items_[begin].code ^ items_[end - 1].code;
    if (differing == 0) return begin + (end - begin) / 2;
    const uint64_t bit = std::bit_floor(differing);
    const auto place =
        std::partition_point(items_.begin() + begin, items_.begin() + end,
                             [bit](const Item& item) { return (item.code & bit) == 0; });
    return static_cast<uint32_t>(place - items_.begin());
  }

  std::span<const FacetBox> boxes_;
  std::vector<Item> items_;
};

BoxTree::BoxTree(std::span<const FacetBox> boxes, std::vector<uint32_t>& order) {
  if (boxes.empty()) return;
  Builder builder(boxes);
  nodes_ = builder.nodes();
  nodes_.shrink_to_fit();
  order = builder.order();
}

FacetTrees::FacetTrees(Facets& facets, size_t operands)
    : firsts_(operands + 1), trees_(operands), facets_(facets), boxes_(facets.facets.size()) {
  for (uint32_t i = 0; i <= operands; ++i) {
    firsts_[i] = static_cast<uint32_t>(
        std::ranges::lower_bound(facets.facets, i, {}, &Facet::operand) - facets.facets.begin());
  }
  std::vector<uint32_t> place_of(facets.touches.empty() ? 0 : facets.facets.size());
  const std::stop_token* const stop = stop_of_work;
  tbb::parallel_for(size_t{0}, operands, [&](size_t i) {
    const StopScope scope(stop);
    stop_point();
    const size_t begin = firsts_[i];
    const size_t count = firsts_[i + 1] - begin;
    std::vector<FacetBox> boxes;
    boxes.reserve(count);
    for (size_t j = 0; j < count; ++j) {
      boxes.push_back(box_around(facets.corners(static_cast<uint32_t>(begin + j))));
    }
    std::vector<uint32_t> order;
    trees_[i] = BoxTree(boxes, order);
    const auto first = facets.facets.begin() + static_cast<std::ptrdiff_t>(begin);
    const std::vector<Facet> before(first, first + static_cast<std::ptrdiff_t>(count));
    for (size_t j = 0; j < count; ++j) {
      facets.facets[begin + j] = before[order[j]];
      boxes_[begin + j] = boxes[order[j]];
      if (!place_of.empty()) place_of[begin + order[j]] = static_cast<uint32_t>(begin + j);
    }
  });
  for (Facets::Touch& touch : facets.touches) touch.facet = place_of[touch.facet];
}

bool FacetTrees::is_beside_plane(const std::array<GridPoint, 3>& corners, const FacetBox& box) {
  const Vec3 origin = to_vec3(corners[0]);
  const Vec3 p = to_vec3(corners[1]) - origin;
  const Vec3 q = to_vec3(corners[2]) - origin;
  // The height of the box's middle over the plane, and of its corners over the middle. `most` has
  // all terms by their magnitudes.
  double height = 0;
  double reach = 0;
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<size_t>(i);
    const int j = kNextAxis[i];
    const int k = kNextAxis[i + 1];
    const double left = p[j] * q[k];
    const double right = p[k] * q[j];
    const double middle = (double{box.min[axis]} + double{box.max[axis]}) / 2 - origin[i];
    const double half = (double{box.max[axis]} - double{box.min[axis]}) / 2;
    height += (left - right) * middle;
    reach += std::abs(left - right) * half;
    most += (std::abs(left) + std::abs(right)) * (std::abs(middle) + half);
  }
  // Ten roundings at most of half an ulp each.
  constexpr double kRounding = 16 * 0x1p-53;
  return std::abs(height) > reach + kRounding * most;
}

bool FacetTrees::meet(uint32_t operand, const FacetBox& box, uint32_t node) const {
  const uint32_t first_facet = first(operand);
  return trees_[operand].visit([&](const FacetBox& other) { return box.meets(other); },
                               [&](uint32_t begin, uint32_t end) {
                                 for (uint32_t facet = begin + first_facet;
                                      facet < end + first_facet; ++facet) {
                                   if (may_meet(facet, box)) return true;
                                 }
                                 return false;
                               },
                               node);
}

}  // namespace csgcore
