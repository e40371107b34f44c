#include "tree/list_expression.hpp"

#include <utility>

namespace csgcore {

/// Merges the blocks if they are operands of one operation, and returns whether they are.
bool ListExpression::combine(Block& block, const Block& next) {
  const bool leads_on_if_true = block.if_true == next.entry && block.if_false == next.if_false &&
                                block.true_jumps == jumps_[next.entry];
  if (leads_on_if_true) {
    block.if_true = next.if_true;
    block.true_jumps = next.true_jumps;
    block.false_jumps += next.false_jumps;
    steps_.push_back(Step::kIntersection);
    return true;
  }
  const bool leads_on_if_false = block.if_false == next.entry && block.if_true == next.if_true &&
                                 block.false_jumps == jumps_[next.entry];
  if (!leads_on_if_false) return false;
  block.if_false = next.if_false;
  block.false_jumps = next.false_jumps;
  block.true_jumps += next.true_jumps;
  steps_.push_back(Step::kUnion);
  return true;
}

void ListExpression::parse(const CellList& list) {
  const uint32_t count = list.count();
  jumps_.assign(count + CellList::kFirst, 0);
  for (uint32_t i = 0; i < count; ++i) {
    ++jumps_[list.if_inside[i]];
    ++jumps_[list.if_outside[i]];
  }
  steps_.clear();
  blocks_.clear();
  for (uint32_t i = 0; i < count; ++i) {
    steps_.push_back(Step::kTest);
    const bool complement = (list.primitive[i] & CellList::kComplementBit) != 0;
    Block block{i + CellList::kFirst, list.if_inside[i], list.if_outside[i], 1, 1};
    if (complement) std::swap(block.if_true, block.if_false);
    while (!blocks_.empty() && combine(block, blocks_.back())) blocks_.pop_back();
    blocks_.push_back(block);
  }
}

}  // namespace csgcore
