#include "evaluate_tree.hpp"

#include <algorithm>
#include <vector>

namespace test_support {

using csgcore::CsgToken;
using csgcore::Op;

bool evaluate_tree(std::span<const CsgToken> tokens, const std::function<bool(uint32_t)>& inside) {
  std::vector<bool> stack;
  for (const CsgToken& token : tokens) {
    if (token.is_primitive) {
      stack.push_back(inside(token.value));
      continue;
    }
    const size_t first = stack.size() - token.value;
    const auto begin = stack.begin() + static_cast<std::ptrdiff_t>(first);
    const bool rest = std::find(begin + 1, stack.end(), true) != stack.end();
    bool value = false;
    if (token.op == Op::kUnion) value = stack[first] || rest;
    if (token.op == Op::kIntersection) value = std::find(begin, stack.end(), false) == stack.end();
    if (token.op == Op::kDifference) value = stack[first] && !rest;
    stack.resize(first);
    stack.push_back(value);
  }
  return !stack.empty() && stack.back();
}

}  // namespace test_support
