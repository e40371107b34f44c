#include "box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace oracle {
namespace {

using csgcore::Box;
using csgcore::Vec3;

/// A box is widened by this share of its coordinates and of the ray's origin, which is far more
/// than the rounding of half a dozen operations.
constexpr double kBoxSlack = 1e-12;

int longest_axis(const Vec3& size) {
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

}  // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes) {
  struct Range {
    size_t begin, end;
  };
  std::vector<uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<Range> open;
  if (!boxes.empty()) open.push_back({0, boxes.size()});
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    const size_t count = range.end - range.begin;
    // A tree of n items has 2n − 1 nodes.
    Node node{{}, kInner, uint32_t(nodes_.size() + 2 * count - 1)};
    for (size_t i = range.begin; i < range.end; ++i) node.box.merge(boxes[order[i]]);
    if (count == 1) {
      node.item = order[range.begin];
    } else {
      const size_t half = range.begin + count / 2;
      const int axis = longest_axis(node.box.size());
      const auto place = [&](size_t i) { return order.begin() + long(i); };
      std::nth_element(place(range.begin), place(half), place(range.end),
                       [&](uint32_t x, uint32_t y) {
                         return boxes[x].center()[axis] < boxes[y].center()[axis];
                       });
      open.push_back({half, range.end});
      open.push_back({range.begin, half});
    }
    nodes_.push_back(node);
  }
}

void BoxTree::find(const Vec3& origin, const Vec3& direction, double first_t,
                   std::vector<uint32_t>& items) const {
  items.clear();
  const Vec3 inverse = 1.0 / direction;
  const double reach = std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z)});
  for (uint32_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    double enter = first_t, leave = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = node.box.min[axis], high = node.box.max[axis];
      const double slack = kBoxSlack * (std::max(std::abs(low), std::abs(high)) + reach);
      const double from = low - slack - origin[axis], to = high + slack - origin[axis];
      if (direction[axis] == 0) {
        if (from > 0 || to < 0) leave = -kInfinity;
        continue;
      }
      enter = std::max(enter, std::min(from * inverse[axis], to * inverse[axis]));
      leave = std::min(leave, std::max(from * inverse[axis], to * inverse[axis]));
    }
    const bool meets = enter <= leave;
    if (meets && node.item != kInner) items.push_back(node.item);
    i = meets ? i + 1 : node.next;
  }
}

}  // namespace oracle
