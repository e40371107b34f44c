// Bounding boxes of the subtrees of a CSG tree.
#pragma once

#include <span>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/csg_tree.hpp"
#include "csgcore/geometry.hpp"

namespace csgcore {

inline Box box_of(const Extent& extent) {
  const Vec3 center{extent.center[0], extent.center[1], extent.center[2]};
  const Vec3 half{extent.half[0], extent.half[1], extent.half[2]};
  return {center - half, center + half};
}

/// Returns, for each token of a tree in postfix order, the box of the token's subtree: for a union
/// the union of the operands' boxes, for an intersection their intersection, for a difference the
/// first operand's box. `box_of(primitive)` gives the box of a primitive.
template <typename BoxOf>
std::vector<Box> subtree_boxes(std::span<const CsgToken> tokens, BoxOf&& box_of) {
  std::vector<Box> boxes(tokens.size());
  std::vector<size_t> roots;  // of operands that wait for their operation
  for (size_t i = 0; i < tokens.size(); ++i) {
    const CsgToken& token = tokens[i];
    if (token.is_primitive) {
      boxes[i] = box_of(token.value);
    } else {
      const size_t first = roots.size() - token.value;
      boxes[i] = boxes[roots[first]];
      for (size_t k = first + 1; k < roots.size() && token.op != Op::kDifference; ++k) {
        const Box& other = boxes[roots[k]];
        if (token.op == Op::kIntersection) {
          boxes[i] = intersection(boxes[i], other);
        } else if (!other.empty()) {
          boxes[i].merge(other);
        }
      }
      roots.resize(first);
    }
    roots.push_back(i);
  }
  return boxes;
}

}  // namespace csgcore
