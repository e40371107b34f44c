#include "edges/face_tree.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace frontend {

using csgcore::Box;
using csgcore::Vec3;

FaceTree::FaceTree(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
  std::vector<uint32_t> order(boxes_.size());
  std::iota(order.begin(), order.end(), 0u);
  struct Part {
    uint32_t begin, end;  // in `order`
  };
  std::vector<Part> open;
  if (!order.empty()) open.push_back({0, static_cast<uint32_t>(order.size())});
  while (!open.empty()) {
    const Part part = open.back();
    open.pop_back();
    Node node{{}, kBranch, 0};
    for (uint32_t i = part.begin; i < part.end; ++i) node.box.merge(boxes_[order[i]]);
    // A binary tree of n leaves has 2n − 1 nodes.
    const uint32_t count = part.end - part.begin;
    node.end = static_cast<uint32_t>(nodes_.size()) + 2 * count - 1;
    if (count == 1) {
      node.face = order[part.begin];
    } else {
      const Vec3 size = node.box.size();
      const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
      const uint32_t middle = part.begin + count / 2;
      std::nth_element(order.begin() + part.begin, order.begin() + middle, order.begin() + part.end,
                       [&](uint32_t a, uint32_t b) {
                         return boxes_[a].min[axis] + boxes_[a].max[axis] <
                                boxes_[b].min[axis] + boxes_[b].max[axis];
                       });
      open.push_back({middle, part.end});
      open.push_back({part.begin, middle});
    }
    nodes_.push_back(node);
  }
}

}  // namespace frontend
