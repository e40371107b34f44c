// The value of a CSG tree for a set of primitives that changes by one primitive at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/csg_tree.hpp"

namespace frontend {

/// Tells whether a point lies in the solid that lies in some of the primitives. At first it lies in
/// none. A change costs as many steps as the tree is deep above the primitive.
class TreeValue {
 public:
  /// Every index in the tree must be below `primitives`.
  TreeValue(const csgcore::CsgTree& tree, uint32_t primitives);

  /// Says whether the point lies in a primitive.
  void set(uint32_t primitive, bool value);
  bool value() const { return !nodes_.empty() && nodes_.back().value; }

 private:
  static constexpr uint32_t kNone = 0xFFFFFFFFu;
  struct Node {
    csgcore::Op op = csgcore::Op::kUnion;
    uint32_t parent = kNone;
    uint32_t operands = 0;       // of an operation; 0: a primitive
    bool is_minuend = false;     // the first operand of a difference
    bool has_minuend = false;    // of a difference: the point lies in its first operand
    uint32_t true_operands = 0;  // the others of a difference, or all operands
    bool value = false;
  };
  void update(uint32_t node, bool value);

  std::vector<Node> nodes_;                    // in the order of the tree's tokens
  std::vector<uint32_t> first_leaf_, leaves_;  // by primitive: its nodes in leaves_
  std::vector<uint8_t> inside_;                // by primitive
};

}  // namespace frontend
