// Which boxes a line may meet: a binary tree of bounding boxes, split at medians.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/geometry.hpp"

namespace oracle {

class BoxTree {
 public:
  /// The items go by their indices.
  explicit BoxTree(const std::vector<csgcore::Box>& boxes);

  /// Sets `items` to those whose boxes the line may meet, in no particular order: certainly all
  /// that it meets at t ≥ first_t.
  void find(const csgcore::Vec3& origin, const csgcore::Vec3& direction, double first_t,
            std::vector<uint32_t>& items) const;

 private:
  static constexpr uint32_t kInner = 0xFFFFFFFFu;
  struct Node {
    csgcore::Box box;
    uint32_t item;  // kInner: it has two children, the first of which is the next node
    uint32_t next;  // where to go on if the line misses the box
  };

  std::vector<Node> nodes_;  // depth first
};

}  // namespace oracle
