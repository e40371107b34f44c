// The value of a CSG tree at a point, while the point enters and leaves primitives.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/csg_tree.hpp"

namespace oracle {

/// The value of a tree at a moving point, which starts outside of all primitives.
class TreeValue {
 public:
  /// All primitive indices of the tree must be below `primitives`.
  TreeValue(const csgcore::CsgTree& tree, size_t primitives);

  bool value() const { return value_; }
  /// Moves the point to the other side of a primitive's surface.
  void flip(uint32_t primitive);

  /// Must be called after the point has changed sides of these primitives. Returns the last of them
  /// in file order to which the turn of the value is due, or kNone if the value has not turned. An
  /// operation's turn is due to those of its operands that turned the same way or, for subtracted
  /// operands, the other way.
  uint32_t turning_primitive(std::span<const uint32_t> changed);

  static constexpr uint32_t kNone = 0xFFFFFFFFu;

  bool names(uint32_t primitive) const { return first_leaf_[primitive] != kNone; }
  /// These return whether the primitive is, somewhere in the tree, within an even number of
  /// subtractions, or within an odd number.
  bool is_added(uint32_t primitive) const { return signs_[primitive] & kAdded; }
  bool is_subtracted(uint32_t primitive) const { return signs_[primitive] & kSubtracted; }

 private:
  static constexpr uint8_t kAdded = 1, kSubtracted = 2;
  /// A node is true if at least `needed` of its operands are in its favour: operands that are true
  /// or, if they are subtracted, false.
  struct Node {
    uint32_t needed = 1;
    uint32_t in_favour = 0;
    uint32_t parent = kNone;
    uint32_t next_leaf = kNone;  // another leaf of the same primitive
    bool is_subtracted = false;  // whether its parent subtracts it
  };
  void find_signs(const csgcore::CsgTree& tree);
  bool holds(uint32_t node) const { return nodes_[node].in_favour >= nodes_[node].needed; }
  bool goes_back_to(uint32_t leaf) const;

  std::vector<Node> nodes_;           // by token; parents come after their operands
  std::vector<uint32_t> first_leaf_;  // by primitive
  std::vector<uint8_t> signs_;
  std::vector<uint8_t> turned_;  // by token: how often the node has turned, modulo 2
  bool value_ = false;
};

}  // namespace oracle
