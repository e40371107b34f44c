#include "tree_value.hpp"

#include <algorithm>

namespace oracle {

using csgcore::CsgToken;
using csgcore::Op;

TreeValue::TreeValue(const csgcore::CsgTree& tree, size_t primitives)
    : nodes_(tree.tokens().size()),
      first_leaf_(primitives, kNone),
      signs_(primitives, 0),
      turned_(nodes_.size(), 0) {
  std::vector<uint32_t> operands;  // the roots of the subtrees so far
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    const CsgToken& token = tree.tokens()[i];
    Node& node = nodes_[i];
    if (token.is_primitive) {
      node.next_leaf = first_leaf_[token.value];
      first_leaf_[token.value] = i;
    } else {
      const bool is_difference = token.op == Op::kDifference;
      node.needed = token.op == Op::kUnion ? 1 : token.value;
      node.in_favour = is_difference ? token.value - 1 : 0;
      const size_t first = operands.size() - token.value;
      for (size_t k = first; k < operands.size(); ++k) {
        nodes_[operands[k]].parent = i;
        nodes_[operands[k]].is_subtracted = is_difference && k > first;
      }
      operands.resize(first);
    }
    operands.push_back(i);
  }
  find_signs(tree);
}

void TreeValue::find_signs(const csgcore::CsgTree& tree) {
  std::vector<uint8_t> sign(nodes_.size(), kAdded);
  for (size_t i = nodes_.size(); i-- > 0;) {
    const Node& node = nodes_[i];
    if (node.parent != kNone) {
      sign[i] = node.is_subtracted ? sign[node.parent] ^ (kAdded | kSubtracted) : sign[node.parent];
    }
    const CsgToken& token = tree.tokens()[i];
    if (token.is_primitive) signs_[token.value] |= sign[i];
  }
}

void TreeValue::flip(uint32_t primitive) {
  for (uint32_t leaf = first_leaf_[primitive]; leaf != kNone; leaf = nodes_[leaf].next_leaf) {
    nodes_[leaf].in_favour = holds(leaf) ? 0 : 1;  // for a leaf: whether the point is inside
    turned_[leaf] ^= 1;
    uint32_t i = leaf;
    for (; nodes_[i].parent != kNone; i = nodes_[i].parent) {
      const uint32_t parent = nodes_[i].parent;
      const bool before = holds(parent);
      nodes_[parent].in_favour += holds(i) != nodes_[i].is_subtracted ? 1u : uint32_t(-1);
      if (holds(parent) == before) break;
      turned_[parent] ^= 1;
    }
    if (nodes_[i].parent == kNone) value_ = holds(i);
  }
}

bool TreeValue::goes_back_to(uint32_t leaf) const {
  if (!turned_[leaf]) return false;
  for (uint32_t i = leaf; nodes_[i].parent != kNone; i = nodes_[i].parent) {
    const uint32_t parent = nodes_[i].parent;
    if (!turned_[parent] || (holds(i) != nodes_[i].is_subtracted) != holds(parent)) return false;
  }
  return true;
}

uint32_t TreeValue::turning_primitive(std::span<const uint32_t> changed) {
  // Flip back, clear the turns, and flip again: turned_ then has the turns due to these primitives.
  for (const uint32_t primitive : changed) flip(primitive);
  std::fill(turned_.begin(), turned_.end(), uint8_t{0});
  for (const uint32_t primitive : changed) flip(primitive);
  uint32_t last = kNone;
  for (const uint32_t primitive : changed) {
    if (last != kNone && primitive < last) continue;
    for (uint32_t leaf = first_leaf_[primitive]; leaf != kNone; leaf = nodes_[leaf].next_leaf) {
      if (goes_back_to(leaf)) last = primitive;
    }
  }
  return last;
}

}  // namespace oracle
