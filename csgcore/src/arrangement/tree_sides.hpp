// The value of a CSG tree on the two sides of a face, from the few operands that hold a point.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "arrangement/facets.hpp"
#include "csgcore/csg_tree.hpp"

namespace csgcore {

/// The work grows with the depth of the operands that hold the point, not with the tree. Not for
/// several threads at once.
class TreeSides {
 public:
  TreeSides(const CsgTree& tree, size_t operand_count);

  struct Face {
    bool is_inside_front;  // of the solid
    bool is_inside_back;
    uint32_t shown;  // one of the operands that changed, if the two differ
  };
  /// `front` and `back`: the operands that hold the points on the two sides. `changed`: those that
  /// hold one of them, in rising order.
  Face face(std::span<const uint32_t> front, std::span<const uint32_t> back,
            std::span<const uint32_t> changed);

 private:
  struct Node {
    uint32_t parent;
    Op op;
    bool is_leaf;
    bool is_first;           // of its parent's operands
    uint32_t operand_count;  // of an operation
  };
  /// What is known of a node's operands on one side.
  struct Value {
    uint32_t round = 0;  // when it was last set
    uint32_t held = 0;   // operands that hold the point
    bool is_first_held = false;
    bool is_held = false;
  };
  bool evaluate(std::span<const uint32_t> operands, std::vector<Value>& values);
  bool is_held(uint32_t node, const std::vector<Value>& values) const {
    return values[node].round == round_ && values[node].is_held;
  }
  int turn(uint32_t node) const { return int{is_held(node, front_)} - int{is_held(node, back_)}; }
  bool is_due(uint32_t leaf) const;

  std::vector<Node> nodes_;           // operands before their operation
  std::vector<uint32_t> first_leaf_;  // by operand, a range of leaves_
  std::vector<uint32_t> leaves_;
  std::vector<Value> front_;  // by node
  std::vector<Value> back_;
  std::vector<uint32_t> heap_;
  uint32_t round_ = 0;
};

}  // namespace csgcore
