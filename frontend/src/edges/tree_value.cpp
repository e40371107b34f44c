#include "edges/tree_value.hpp"

namespace frontend {

using csgcore::CsgToken;
using csgcore::Op;

TreeValue::TreeValue(const csgcore::CsgTree& tree, uint32_t primitives)
    : first_leaf_(primitives + 1), inside_(primitives) {
  std::vector<uint32_t> stack;
  for (const CsgToken& token : tree.tokens()) {
    const auto node = static_cast<uint32_t>(nodes_.size());
    nodes_.emplace_back();
    if (token.is_primitive) {
      ++first_leaf_[token.value + 1];
    } else {
      nodes_[node].op = token.op;
      nodes_[node].operands = token.value;
      for (uint32_t i = 0; i < token.value; ++i) {
        Node& operand = nodes_[stack[stack.size() - token.value + i]];
        operand.parent = node;
        operand.is_minuend = i == 0 && token.op == Op::kDifference;
      }
      stack.resize(stack.size() - token.value);
    }
    stack.push_back(node);
  }
  for (uint32_t i = 0; i < primitives; ++i) first_leaf_[i + 1] += first_leaf_[i];
  leaves_.resize(first_leaf_.back());
  std::vector<uint32_t> next = first_leaf_;
  uint32_t node = 0;
  for (const CsgToken& token : tree.tokens()) {
    if (token.is_primitive) leaves_[next[token.value]++] = node;
    ++node;
  }
}

void TreeValue::set(uint32_t primitive, bool value) {
  if ((inside_[primitive] != 0) == value) return;
  inside_[primitive] = value ? 1 : 0;
  for (uint32_t i = first_leaf_[primitive]; i < first_leaf_[primitive + 1]; ++i) {
    update(leaves_[i], value);
  }
}

void TreeValue::update(uint32_t node, bool value) {
  while (nodes_[node].value != value) {
    nodes_[node].value = value;
    const bool is_minuend = nodes_[node].is_minuend;
    node = nodes_[node].parent;
    if (node == kNone) return;
    Node& parent = nodes_[node];
    if (is_minuend) {
      parent.has_minuend = value;
    } else {
      parent.true_operands += value ? 1u : ~0u;
    }
    switch (parent.op) {
      case Op::kUnion:
        value = parent.true_operands > 0;
        break;
      case Op::kIntersection:
        value = parent.true_operands == parent.operands;
        break;
      case Op::kDifference:
        value = parent.has_minuend && parent.true_operands == 0;
        break;
    }
  }
}

}  // namespace frontend
