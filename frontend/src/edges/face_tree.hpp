// Finds the faces of a body that reach into a box.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/geometry.hpp"

namespace frontend {

/// Returns whether two boxes, one of them grown by `margin`, have a point in common.
inline bool touch(const csgcore::Box& a, const csgcore::Box& b, double margin) {
  return a.min.x <= b.max.x + margin && b.min.x <= a.max.x + margin &&
         a.min.y <= b.max.y + margin && b.min.y <= a.max.y + margin &&
         a.min.z <= b.max.z + margin && b.min.z <= a.max.z + margin;
}

/// A hierarchy of the boxes of faces.
class FaceTree {
 public:
  FaceTree() = default;
  explicit FaceTree(std::vector<csgcore::Box> boxes);

  const csgcore::Box& box_of(uint32_t face) const { return boxes_[face]; }

  /// Calls visit(face) for each face whose box, grown by `margin`, touches the given one. Counts
  /// `steps` up by one for each box that it looks at.
  template <typename Visit>
  void for_each_near(const csgcore::Box& box, double margin, uint64_t& steps, Visit visit) const {
    for (uint32_t i = 0; i < nodes_.size();) {
      const Node& node = nodes_[i];
      ++steps;
      if (!touch(node.box, box, margin)) {
        i = node.end;
        continue;
      }
      if (node.face != kBranch) visit(node.face);
      ++i;
    }
  }

 private:
  static constexpr uint32_t kBranch = 0xFFFFFFFFu;
  /// In preorder: the nodes below a branch follow it, up to `end`.
  struct Node {
    csgcore::Box box;
    uint32_t face;  // kBranch: none
    uint32_t end;
  };
  std::vector<csgcore::Box> boxes_;
  std::vector<Node> nodes_;
};

}  // namespace frontend
