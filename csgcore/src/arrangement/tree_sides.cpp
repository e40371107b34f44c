#include "arrangement/tree_sides.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace csgcore {

TreeSides::TreeSides(const CsgTree& tree, size_t operand_count)
    : first_leaf_(operand_count + 1, 0) {
  std::vector<uint32_t> open;  // nodes without a parent so far
  for (const CsgToken& token : tree.tokens()) {
    const auto number = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back({kNoPlace, token.op, token.is_primitive, true, token.value});
    if (token.is_primitive) {
      ++first_leaf_[token.value + 1];
    } else {
      const size_t first = open.size() - token.value;
      for (size_t i = first; i < open.size(); ++i) {
        nodes_[open[i]].parent = number;
        nodes_[open[i]].is_first = i == first;
      }
      open.resize(first);
    }
    open.push_back(number);
  }
  std::partial_sum(first_leaf_.begin(), first_leaf_.end(), first_leaf_.begin());
  leaves_.resize(first_leaf_.back());
  std::vector<uint32_t> next(first_leaf_);
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].is_leaf) leaves_[next[nodes_[i].operand_count]++] = i;
  }
  front_.resize(nodes_.size());
  back_.resize(nodes_.size());
}

/// Of a point that no operand holds every operation is false. So only nodes that hold the point
/// tell their parents.
bool TreeSides::evaluate(std::span<const uint32_t> operands, std::vector<Value>& values) {
  if (nodes_.empty()) return false;
  for (const uint32_t operand : operands) {
    for (uint32_t i = first_leaf_[operand]; i < first_leaf_[operand + 1]; ++i) {
      values[leaves_[i]] = {round_, 0, false, false};
      heap_.push_back(leaves_[i]);
    }
  }
  // The least node first: its operands come before it.
  std::ranges::make_heap(heap_, std::greater());
  while (!heap_.empty()) {
    std::ranges::pop_heap(heap_, std::greater());
    const uint32_t number = heap_.back();
    heap_.pop_back();
    const Node& node = nodes_[number];
    Value& value = values[number];
    if (node.is_leaf || node.op == Op::kUnion) {
      value.is_held = true;
    } else if (node.op == Op::kIntersection) {
      value.is_held = value.held == node.operand_count;
    } else {
      value.is_held = value.is_first_held && value.held == 1;
    }
    if (!value.is_held || node.parent == kNoPlace) continue;
    Value& above = values[node.parent];
    if (above.round != round_) {
      above = {round_, 0, false, false};
      heap_.push_back(node.parent);
      std::ranges::push_heap(heap_, std::greater());
    }
    ++above.held;
    above.is_first_held = above.is_first_held || node.is_first;
  }
  return is_held(static_cast<uint32_t>(nodes_.size() - 1), values);
}

/// Returns whether the turn of the solid is due to that of the leaf (NUMERICS.md §1.4).
bool TreeSides::is_due(uint32_t leaf) const {
  uint32_t at = leaf;
  while (turn(at) != 0) {
    const Node& node = nodes_[at];
    if (node.parent == kNoPlace) return true;
    const bool is_subtracted = nodes_[node.parent].op == Op::kDifference && !node.is_first;
    if (turn(node.parent) != (is_subtracted ? -turn(at) : turn(at))) return false;
    at = node.parent;
  }
  return false;
}

TreeSides::Face TreeSides::face(std::span<const uint32_t> front, std::span<const uint32_t> back,
                                std::span<const uint32_t> changed) {
  ++round_;
  Face result{evaluate(front, front_), evaluate(back, back_), kNoPlace};
  if (result.is_inside_front == result.is_inside_back) return result;
  for (const uint32_t operand : changed) {
    for (uint32_t i = first_leaf_[operand]; i < first_leaf_[operand + 1]; ++i) {
      if (is_due(leaves_[i])) result.shown = operand;
    }
  }
  return result;
}

}  // namespace csgcore
