#include "csgcore/csg_tree.hpp"

#include <cassert>
#include <utility>

namespace csgcore {

CsgTree subtract(const CsgTree& tree, uint32_t primitive) {
  if (tree.empty()) return {};
  CsgTree result = tree;
  std::vector<CsgToken>& tokens = result.tokens_;
  CsgToken root{false, Op::kDifference, 1};
  const bool is_difference = !tokens.back().is_primitive && tokens.back().op == Op::kDifference;
  if (is_difference) {
    root = tokens.back();
    tokens.pop_back();
  }
  ++root.value;
  tokens.push_back({true, Op::kUnion, primitive});
  tokens.push_back(root);
  return result;
}

CsgTree renamed(const CsgTree& tree, const std::function<uint32_t(uint32_t)>& name) {
  CsgTree result = tree;
  for (CsgToken& token : result.tokens_) {
    if (token.is_primitive) token.value = name(token.value);
  }
  return result;
}

void CsgTreeBuilder::open(Op op) {
  frames_.push_back({op, static_cast<uint32_t>(tokens_.size()), 0, false, false});
}

void CsgTreeBuilder::primitive(uint32_t index) {
  const bool wanted = frames_.empty() || !frames_.back().is_empty;
  if (wanted) tokens_.push_back({true, Op::kUnion, index});
  add_operand(wanted ? Operand::kTokens : Operand::kEmpty);
}

void CsgTreeBuilder::empty() { add_operand(Operand::kEmpty); }

void CsgTreeBuilder::add_operand(Operand operand) {
  if (frames_.empty()) {
    if (operand == Operand::kTokens) ++top_level_operands_;
    return;
  }
  Frame& frame = frames_.back();
  const bool first = !std::exchange(frame.has_first, true);
  if (operand == Operand::kTokens) {
    ++frame.operand_count;
  } else if (frame.op == Op::kIntersection || (frame.op == Op::kDifference && first)) {
    frame.is_empty = true;
    frame.operand_count = 0;
    tokens_.resize(frame.first_token);
  }
}

void CsgTreeBuilder::close() {
  assert(!frames_.empty());
  const Frame frame = frames_.back();
  frames_.pop_back();
  // An operand of an operation that is already empty contributes nothing.
  if (!frames_.empty() && frames_.back().is_empty) tokens_.resize(frame.first_token);
  if (frame.operand_count == 0 || tokens_.size() == frame.first_token) {
    add_operand(Operand::kEmpty);
    return;
  }
  if (frame.operand_count == 1) {
    // The lone operand takes this node's place. The operand's own root may now be directly under an
    // operation into which it can dissolve.
    if (!tokens_.back().is_primitive) {
      const CsgToken root = tokens_.back();
      tokens_.pop_back();
      frames_.push_back({root.op, frame.first_token, root.value, false, true});
      close();
      return;
    }
    add_operand(Operand::kTokens);
    return;
  }
  // Flattening: the operands become the enclosing operation's own.
  const bool at_top = frames_.empty();
  const Op outer = at_top ? Op::kUnion : frames_.back().op;
  const bool is_first = !at_top && !frames_.back().has_first;
  bool dissolves = frame.op == outer;
  if (!at_top && outer == Op::kDifference) {
    dissolves = is_first ? frame.op == Op::kDifference : frame.op == Op::kUnion;
  }
  if (dissolves) {
    if (at_top) {
      top_level_operands_ += frame.operand_count;
    } else {
      frames_.back().has_first = true;
      frames_.back().operand_count += frame.operand_count;
    }
    return;
  }
  tokens_.push_back({false, frame.op, frame.operand_count});
  add_operand(Operand::kTokens);
}

CsgTree CsgTreeBuilder::finish() {
  assert(frames_.empty());
  if (top_level_operands_ > 1) tokens_.push_back({false, Op::kUnion, top_level_operands_});
  top_level_operands_ = 0;
  CsgTree tree;
  tree.tokens_ = std::exchange(tokens_, {});
  return tree;
}

}  // namespace csgcore
