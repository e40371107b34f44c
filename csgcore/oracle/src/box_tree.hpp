// A binary tree of bounding boxes, split at medians, which finds the boxes that a line may meet.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "csgcore/geometry.hpp"

namespace oracle {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class BoxTree {
 public:
  /// The items are the indices of the boxes.
  explicit BoxTree(const std::vector<csgcore::Box>& boxes);

  /// Sets `items` to those whose boxes the line may meet, in no particular order. They include all
  /// that it meets at t ≥ first_t.
  void find(const csgcore::Vec3& origin, const csgcore::Vec3& direction, double first_t,
            std::vector<uint32_t>& items) const;

 private:
  static constexpr uint32_t kInner = 0xFFFFFFFFu;
  struct Node {
    csgcore::Box box;
    uint32_t item;  // kInner: the node has two children, the first of which is the next node
    uint32_t next;  // the node after this subtree
  };

  std::vector<Node> nodes_;  // in preorder
};

}  // namespace oracle
