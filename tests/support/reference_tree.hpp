// Keeps the value of a CSG tree while primitives are entered and left one by one, for the
// reference.
#pragma once

#include <span>
#include <vector>

#include "csgcore/csg_tree.hpp"

namespace csgcore::reference {

/// Every node counts its operands that hold. A primitive that changes sides is counted up the tree
/// as far as values change. At first the point is outside all primitives.
class CountingTree {
 public:
  /// The object numbers the primitives of the tokens by slots: slots()[i] is the primitive of slot
  /// i, in ascending order.
  explicit CountingTree(std::span<const CsgToken> tokens);

  std::span<const uint32_t> slots() const { return primitives_; }
  bool value() const { return !nodes_.empty() && nodes_.back().value; }
  bool inside(uint32_t slot) const { return nodes_[first_leaf_[slot]].value; }
  void flip(uint32_t slot);

  static constexpr uint32_t kNone = 0xFFFFFFFFu;
  /// Returns the slot to which a turn of the value is due, if the point has changed sides of the
  /// primitives in `changed` (by slot). It is the greatest slot that has turned in the direction
  /// that turns the operation, as have all operations above it. kNone if the value stays the same.
  uint32_t turning_slot(const std::vector<uint8_t>& changed) const;

 private:
  struct Node {
    Op op = Op::kUnion;
    bool is_first = false;  // first of its parent's operands
    bool value = false;
    bool first_holds = false;    // of differences, which do not count their first operand
    uint32_t parent = kNone;     // greater than the node's own index
    uint32_t operands = 0;       // 0: a primitive
    uint32_t holding = 0;        // operands that hold
    uint32_t next_leaf = kNone;  // another leaf of the same primitive
  };
  void change(uint32_t leaf);

  std::vector<Node> nodes_;  // postfix order: the root is last
  std::vector<uint32_t> primitives_;
  std::vector<uint32_t> first_leaf_;  // by slot
};

/// Returns the primitives that the tokens name, in ascending order.
std::vector<uint32_t> primitives_of(std::span<const CsgToken> tokens);

/// Returns the tree with the primitives that are not alive replaced by the empty set.
std::vector<CsgToken> reduce(std::span<const CsgToken> tokens, const std::vector<uint8_t>& alive);

}  // namespace csgcore::reference
