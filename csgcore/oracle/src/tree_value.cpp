#include "tree_value.hpp"

namespace oracle {

using csgcore::CsgToken;
using csgcore::Op;

TreeValue::TreeValue(const csgcore::CsgTree& tree, size_t primitives)
    : nodes_(tree.tokens().size()), first_leaf_(primitives, kNone), signs_(primitives, 0) {
  std::vector<uint32_t> operands;  // roots of the subtrees so far
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
    bool now = nodes_[leaf].in_favour == 0;  // of a leaf: whether the point is inside
    nodes_[leaf].in_favour = now;
    uint32_t i = leaf;
    for (; nodes_[i].parent != kNone; i = nodes_[i].parent) {
      Node& parent = nodes_[nodes_[i].parent];
      const bool before = parent.in_favour >= parent.needed;
      parent.in_favour += now != nodes_[i].is_subtracted ? 1u : uint32_t(-1);
      now = parent.in_favour >= parent.needed;
      if (now == before) break;
    }
    if (nodes_[i].parent == kNone) value_ = now;
  }
}

}  // namespace oracle
