#include "arrangement/facet_trees.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
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

class BoxTree::Builder {
 public:
  explicit Builder(std::span<const FacetBox> boxes) : boxes_(boxes), items_(boxes.size()) {
    for (uint32_t i = 0; i < items_.size(); ++i) {
      items_[i].number = i;
      for (size_t j = 0; j < 3; ++j) items_[i].center[j] = boxes[i].min[j] + boxes[i].max[j];
    }
  }

  std::vector<Node> nodes() {
    std::vector<Node> result;
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
  struct Item {
    std::array<float, 3> center;
    uint32_t number;
  };

  /// Appends the nodes. Recurses as deep as the tree is, which is balanced.
  void build(uint32_t begin, uint32_t end, std::vector<Node>& nodes) {
    const auto number = static_cast<uint32_t>(nodes.size());
    constexpr uint32_t kFew = 4;
    constexpr uint32_t kManyAtOnce = 16'384;
    if (end - begin <= kFew) {
      // What std::nth_element leaves open does not count.
      std::ranges::sort(items(begin, end), {}, &Item::number);
      FacetBox box = boxes_[items_[begin].number];
      for (const Item& item : items(begin, end)) box.merge(boxes_[item.number]);
      nodes.push_back({box, begin, end, number + 1});
      return;
    }
    const uint32_t middle = begin + (end - begin) / 2;
    divide(begin, middle, end);
    nodes.push_back({{}, begin, end, 0});
    const uint32_t low = number + 1;
    if (end - begin < kManyAtOnce) {
      build(begin, middle, nodes);
      build(middle, end, nodes);
    } else {
      std::array<std::vector<Node>, 2> halves;
      const std::stop_token* const stop = stop_of_work;
      const auto build_half = [&](uint32_t from, uint32_t to, std::vector<Node>& half) {
        const StopScope scope(stop);
        stop_point();
        build(from, to, half);
      };
      tbb::parallel_invoke([&] { build_half(begin, middle, halves[0]); },
                           [&] { build_half(middle, end, halves[1]); });
      for (const std::vector<Node>& half : halves) {
        const auto first = static_cast<uint32_t>(nodes.size());
        for (const Node& node : half) {
          nodes.push_back({node.box, node.begin, node.end, node.after + first});
        }
      }
    }
    nodes[number].after = static_cast<uint32_t>(nodes.size());
    nodes[number].box = nodes[low].box;
    nodes[number].box.merge(nodes[nodes[low].after].box);
  }

  /// Puts those of lesser centres along the longest axis before the middle.
  void divide(uint32_t begin, uint32_t middle, uint32_t end) {
    std::array<float, 3> least = items_[begin].center;
    std::array<float, 3> most = least;
    for (const Item& item : items(begin, end)) {
      for (size_t i = 0; i < 3; ++i) {
        least[i] = std::min(least[i], item.center[i]);
        most[i] = std::max(most[i], item.center[i]);
      }
    }
    size_t axis = 0;
    for (size_t i = 1; i < 3; ++i) {
      if (most[i] - least[i] > most[axis] - least[axis]) axis = i;
    }
    const std::span<Item> all = items(begin, end);
    std::nth_element(all.begin(), all.begin() + (middle - begin), all.end(),
                     [axis](const Item& a, const Item& b) {
                       return a.center[axis] < b.center[axis] ||
                              (a.center[axis] == b.center[axis] && a.number < b.number);
                     });
  }

  std::span<Item> items(uint32_t begin, uint32_t end) {
    return std::span(items_).subspan(begin, end - begin);
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

bool FacetTrees::meet(uint32_t operand, const FacetBox& box) const {
  return trees_[operand].visit([&](const FacetBox& other) { return box.meets(other); },
                               [&](uint32_t begin, uint32_t end) {
                                 for (uint32_t facet = begin; facet < end; ++facet) {
                                   if (box.meets(boxes_[facet + first(operand)])) return true;
                                 }
                                 return false;
                               });
}

}  // namespace csgcore
