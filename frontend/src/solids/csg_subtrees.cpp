#include "solids/csg_subtrees.hpp"

#include <algorithm>

namespace frontend {

using csgcore::Box;
using csgcore::CsgToken;
using csgcore::CsgTreeBuilder;
using csgcore::Op;

CsgSubtrees::CsgSubtrees(std::span<const CsgToken> tokens)
    : tokens_(tokens), firsts_(tokens.size()) {
  std::vector<uint32_t> starts;  // of the subtrees that no operation has taken
  for (uint32_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].is_primitive) {
      starts.push_back(i);
    } else {
      starts.resize(starts.size() - tokens[i].value + 1);
    }
    firsts_[i] = starts.back();
  }
}

std::vector<uint32_t> CsgSubtrees::operands(uint32_t root) const {
  std::vector<uint32_t> result(tokens_[root].value);
  uint32_t end = root;
  for (auto operand = result.rbegin(); operand != result.rend(); ++operand) {
    *operand = end - 1;
    end = firsts_[*operand];
  }
  return result;
}

std::vector<Box> subtree_boxes(std::span<const CsgToken> tokens, std::span<const Box> boxes) {
  std::vector<Box> result(tokens.size());
  std::vector<size_t> operands;
  for (size_t i = 0; i < tokens.size(); ++i) {
    const CsgToken& token = tokens[i];
    if (token.is_primitive) {
      result[i] = boxes[token.value];
    } else {
      const size_t first = operands.size() - token.value;
      result[i] = result[operands[first]];
      for (size_t k = first + 1; k < operands.size(); ++k) {
        const Box& operand = result[operands[k]];
        if (token.op == Op::kUnion) result[i].merge(operand);
        if (token.op == Op::kIntersection) {
          result[i] = csgcore::intersection(result[i], operand);
        }
      }
      operands.resize(first);
    }
    operands.push_back(i);
  }
  return result;
}

std::vector<uint32_t> primitives_of(std::span<const CsgToken> tokens) {
  std::vector<uint32_t> result;
  for (const CsgToken& token : tokens) {
    if (token.is_primitive) result.push_back(token.value);
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

bool is_union(const csgcore::CsgTree& tree) {
  return std::ranges::all_of(tree.tokens(), [](const CsgToken& token) {
    return token.is_primitive || token.op == Op::kUnion;
  });
}

void add_tree(std::span<const CsgToken> tokens, CsgTreeBuilder& builder) {
  rebuild(tokens, builder, [](CsgTreeBuilder& to, uint32_t index) { to.primitive(index); });
}

}  // namespace frontend
