#include "solids/leaves.hpp"

#include <algorithm>
#include <limits>

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::CsgToken;
using csgcore::CsgTree;
using csgcore::CsgTreeBuilder;
using csgcore::Op;
using csgcore::Vec3;

/// An operation on the way from the root to a leaf.
struct OperationAround {
  Op op;
  bool is_subtracted;
  uint32_t operands_left;  // the last operand comes first
  Box context;             // where the operands can be seen
};

/// By the tokens' order, whether boxes tell that the subtree is empty, or of no consequence.
std::vector<bool> empty_subtrees(std::span<const CsgToken> tokens, std::span<const Box> subtree) {
  std::vector<bool> is_empty(tokens.size());
  std::vector<uint32_t> operands;  // the roots of those that no operation has taken
  for (uint32_t i = 0; i < tokens.size(); ++i) {
    if (!tokens[i].is_primitive) {
      const auto first = operands.end() - tokens[i].value;
      for (auto operand = first + 1; operand != operands.end(); ++operand) {
        is_empty[*operand] = is_empty[*operand] ||
                             (tokens[i].op == Op::kDifference &&
                              csgcore::intersection(subtree[*first], subtree[*operand]).empty());
      }
      operands.erase(first, operands.end());
    }
    is_empty[i] = subtree[i].empty();
    operands.push_back(i);
  }
  return is_empty;
}

/// Calls visit(LeafUse) for each leaf, from the last one to the first.
template <typename Visit>
void visit_uses(std::span<const CsgToken> tokens, std::span<const Box> subtree,
                const Visit& visit) {
  const Box everywhere{Vec3(-std::numeric_limits<double>::infinity()),
                       Vec3(std::numeric_limits<double>::infinity())};
  std::vector<OperationAround> open;
  for (size_t i = tokens.size(); i-- > 0;) {
    bool is_subtracted = false;
    Box context = everywhere;
    if (!open.empty()) {
      const OperationAround& parent = open.back();
      const bool is_later = parent.op == Op::kDifference && parent.operands_left > 1;
      is_subtracted = parent.is_subtracted != is_later;
      context = parent.context;
    }
    if (!tokens[i].is_primitive) {
      // A negated intersection is a union of complements: its operands do not bound one another.
      const bool bounds = !is_subtracted && tokens[i].op != Op::kUnion;
      open.push_back({tokens[i].op, is_subtracted, tokens[i].value,
                      bounds ? csgcore::intersection(context, subtree[i]) : context});
      continue;
    }
    const bool meets_others = !csgcore::intersection(subtree[i], context).empty();
    visit(LeafUse{tokens[i].value, is_subtracted, meets_others});
    while (!open.empty() && --open.back().operands_left == 0) open.pop_back();
  }
}

}  // namespace

uint32_t Leaves::add(CsgTree solid, uint32_t frame, const std::optional<Box>& box) {
  compound_.push_back({std::move(solid), frame, box});
  return primitive_count_ + static_cast<uint32_t>(compound_.size()) - 1;
}

uint32_t Leaves::first_primitive(uint32_t leaf) const {
  return is_compound(leaf) ? solid(leaf).tokens().front().value : leaf;
}

CsgTree Leaves::expanded(LeafTree tree) const {
  if (!has_compound()) return tree;
  CsgTreeBuilder builder;
  rebuild(tree.tokens(), builder, [&](CsgTreeBuilder& to, uint32_t leaf) {
    if (is_compound(leaf)) {
      add_tree(solid(leaf).tokens(), to);
    } else {
      to.primitive(leaf);
    }
  });
  return builder.finish();
}

LeafTree pruned(const LeafTree& tree, std::span<const Box> boxes) {
  const std::span<const CsgToken> tokens = tree.tokens();
  const std::vector<bool> is_empty = empty_subtrees(tokens, subtree_boxes(tokens, boxes));
  CsgTreeBuilder builder;
  rebuild(
      tokens, builder, [](CsgTreeBuilder& to, uint32_t leaf) { to.primitive(leaf); },
      [&](uint32_t root) { return is_empty[root]; });
  return builder.finish();
}

std::vector<LeafUse> uses_of_leaves(const LeafTree& tree, std::span<const Box> boxes) {
  std::vector<LeafUse> uses;
  visit_uses(tree.tokens(), subtree_boxes(tree.tokens(), boxes),
             [&](const LeafUse& use) { uses.push_back(use); });
  std::reverse(uses.begin(), uses.end());
  return uses;
}

Box box_of_positive_leaves(const LeafTree& tree, std::span<const Box> boxes) {
  // A large design has few trees, and hundreds of MB: its subtrees' boxes are found once.
  std::vector<Box> subtree = subtree_boxes(tree.tokens(), boxes);
  const std::vector<bool> is_empty = empty_subtrees(tree.tokens(), subtree);
  LeafTree without_empty;
  std::span<const CsgToken> tokens = tree.tokens();
  if (std::find(is_empty.begin(), is_empty.end(), true) != is_empty.end()) {
    without_empty = pruned(tree, boxes);
    tokens = without_empty.tokens();
    subtree = subtree_boxes(tokens, boxes);
  }
  Box result;
  visit_uses(tokens, subtree, [&](const LeafUse& use) {
    if (!use.is_subtracted && use.meets_others) result.merge(boxes[use.leaf]);
  });
  return result;
}

}  // namespace frontend
