#include "reference_tree.hpp"

#include <algorithm>

namespace csgcore::reference {

CountingTree::CountingTree(std::span<const CsgToken> tokens)
    : nodes_(tokens.size()),
      primitives_(primitives_of(tokens)),
      first_leaf_(primitives_.size(), kNone) {
  std::vector<uint32_t> stack;
  for (uint32_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].is_primitive) {
      const auto at = std::lower_bound(primitives_.begin(), primitives_.end(), tokens[i].value);
      uint32_t& first = first_leaf_[size_t(at - primitives_.begin())];
      nodes_[i].next_leaf = first;
      first = i;
    } else {
      nodes_[i].op = tokens[i].op;
      nodes_[i].operands = tokens[i].value;
      const size_t first = stack.size() - tokens[i].value;
      nodes_[stack[first]].is_first = true;
      for (size_t k = first; k < stack.size(); ++k) nodes_[stack[k]].parent = i;
      stack.resize(first);
    }
    stack.push_back(i);
  }
}

void CountingTree::flip(uint32_t slot) {
  for (uint32_t leaf = first_leaf_[slot]; leaf != kNone; leaf = nodes_[leaf].next_leaf) {
    change(leaf);
  }
}

void CountingTree::change(uint32_t index) {
  nodes_[index].value = !nodes_[index].value;
  while (nodes_[index].parent != kNone) {
    const Node& changed = nodes_[index];
    Node& node = nodes_[changed.parent];
    if (node.op == Op::kDifference && changed.is_first) {
      node.first_holds = changed.value;
    } else if (changed.value) {
      ++node.holding;
    } else {
      --node.holding;
    }
    const bool value = node.op == Op::kUnion          ? node.holding > 0
                       : node.op == Op::kIntersection ? node.holding == node.operands
                                                      : node.first_holds && node.holding == 0;
    if (value == node.value) return;
    node.value = value;
    index = changed.parent;
  }
}

uint32_t CountingTree::turning_slot(const std::vector<uint8_t>& changed) const {
  struct Turn {
    bool before, behind;
    uint32_t slot;  // to which the change is due, if the values differ
  };
  std::vector<uint32_t> slot_of(nodes_.size(), kNone);
  for (uint32_t slot = 0; slot < first_leaf_.size(); ++slot) {
    for (uint32_t leaf = first_leaf_[slot]; leaf != kNone; leaf = nodes_[leaf].next_leaf) {
      slot_of[leaf] = slot;
    }
  }
  std::vector<Turn> stack;
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (node.operands == 0) {
      const uint32_t slot = slot_of[i];
      stack.push_back({node.value != (changed[slot] != 0), node.value, slot});
      continue;
    }
    const size_t first = stack.size() - node.operands;
    // An intersection holds unless an operand fails. A union is the negation of an intersection of
    // negations, a difference an intersection with negations.
    const bool negated = node.op == Op::kUnion;
    Turn turn{true, true, kNone};
    for (size_t k = first; k < stack.size(); ++k) {
      const bool is_negated = negated || (node.op == Op::kDifference && k > first);
      turn.before &= stack[k].before != is_negated;
      turn.behind &= stack[k].behind != is_negated;
    }
    for (size_t k = first; k < stack.size(); ++k) {
      const bool is_negated = negated || (node.op == Op::kDifference && k > first);
      const bool turns = stack[k].before != stack[k].behind;
      if (!turns || (stack[k].behind != is_negated) != turn.behind) continue;
      if (turn.slot == kNone || stack[k].slot > turn.slot) turn.slot = stack[k].slot;
    }
    if (negated) turn.before = !turn.before, turn.behind = !turn.behind;
    stack.resize(first);
    stack.push_back(turn);
  }
  const bool has_turned = !stack.empty() && stack.back().before != stack.back().behind;
  return has_turned ? stack.back().slot : kNone;
}

std::vector<uint32_t> primitives_of(std::span<const CsgToken> tokens) {
  std::vector<uint32_t> primitives;
  for (const CsgToken& token : tokens) {
    if (token.is_primitive) primitives.push_back(token.value);
  }
  std::sort(primitives.begin(), primitives.end());
  primitives.erase(std::unique(primitives.begin(), primitives.end()), primitives.end());
  return primitives;
}

std::vector<CsgToken> reduce(std::span<const CsgToken> tokens, const std::vector<uint8_t>& alive) {
  std::vector<CsgToken> out;
  std::vector<size_t> starts;  // where the operands on the stack begin in `out`
  for (const CsgToken& token : tokens) {
    if (token.is_primitive) {
      starts.push_back(out.size());
      if (alive[token.value]) out.push_back(token);
      continue;
    }
    const size_t first = starts.size() - token.value;
    uint32_t operands = 0;
    for (size_t i = first; i < starts.size(); ++i) {
      operands += (i + 1 < starts.size() ? starts[i + 1] : out.size()) > starts[i];
    }
    const bool first_is_empty = starts[first + 1] == starts[first];
    const bool empty = (token.op == Op::kIntersection && operands < token.value) ||
                       (token.op == Op::kDifference && first_is_empty);
    if (empty) out.resize(starts[first]);
    if (!empty && operands > 1) out.push_back({false, token.op, operands});
    starts.resize(first + 1);
  }
  // The tree itself remains on the stack.
  return out;
}

}  // namespace csgcore::reference
