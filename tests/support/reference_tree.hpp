// The value of a CSG tree while primitives are entered and left one by one, for the reference.
#pragma once

#include <span>
#include <vector>

#include "csgcore/csg_tree.hpp"

namespace csgcore::reference {

/// Every node counts its operands that hold; a primitive that changes sides is counted up the tree
/// as far as values change. In the beginning a point is outside all primitives.
class CountingTree {
 public:
  /// The primitives that the tokens name go by their slots from here on: slots()[i] is that of slot
  /// i, in ascending order.
  explicit CountingTree(std::span<const CsgToken> tokens);

  std::span<const uint32_t> slots() const { return primitives_; }
  bool value() const { return !nodes_.empty() && nodes_.back().value; }
  bool inside(uint32_t slot) const { return nodes_[first_leaf_[slot]].value; }
  void flip(uint32_t slot);

  static constexpr uint32_t kNone = 0xFFFFFFFFu;
  /// By which slot the value has turned, if the point has changed sides of those in `changed` (by
  /// slot): the greatest that is, as are all operations that it is under, an operand that turned
  /// the way which turns the operation. kNone if the value is the same.
  uint32_t turning_slot(const std::vector<uint8_t>& changed) const;

 private:
  struct Node {
    Op op = Op::kUnion;
    bool is_first = false;  // of its parent's operands
    bool value = false;
    bool first_holds = false;    // differences only; their first operand is not counted
    uint32_t parent = kNone;     // greater than the node's own index
    uint32_t operands = 0;       // 0: a primitive
    uint32_t holding = 0;        // operands that hold
    uint32_t next_leaf = kNone;  // another one of the same primitive
  };
  void change(uint32_t leaf);

  std::vector<Node> nodes_;  // postfix: the root is last
  std::vector<uint32_t> primitives_;
  std::vector<uint32_t> first_leaf_;  // by slot
};

/// The primitives that the tokens name, in ascending order.
std::vector<uint32_t> primitives_of(std::span<const CsgToken> tokens);

/// The tree without the primitives that are not alive, which are the empty set here.
std::vector<CsgToken> reduce(std::span<const CsgToken> tokens, const std::vector<uint8_t>& alive);

}  // namespace csgcore::reference
