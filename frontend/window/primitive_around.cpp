#include "primitive_around.hpp"

#include <algorithm>
#include <vector>

namespace window {

std::optional<uint32_t> primitive_around(const csgcore::CsgTree& tree,
                                         const std::function<bool(uint32_t primitive)>& contains) {
  using Found = std::optional<uint32_t>;
  std::vector<Found> operands;  // of the operations that are not complete
  for (const csgcore::CsgToken& token : tree.tokens()) {
    if (token.is_primitive) {
      operands.push_back(contains(token.value) ? Found(token.value) : std::nullopt);
      continue;
    }
    const auto first = operands.end() - token.value;
    const auto is_solid = [](const Found& operand) { return operand.has_value(); };
    Found result = *first;
    switch (token.op) {
      case csgcore::Op::kUnion:
        if (const auto any = std::find_if(first, operands.end(), is_solid); any != operands.end()) {
          result = *any;
        }
        break;
      case csgcore::Op::kIntersection:
        if (!std::all_of(first, operands.end(), is_solid)) result.reset();
        break;
      case csgcore::Op::kDifference:
        if (std::any_of(first + 1, operands.end(), is_solid)) result.reset();
        break;
    }
    operands.erase(first, operands.end());
    operands.push_back(result);
  }
  return operands.empty() ? std::nullopt : operands.front();
}

}  // namespace window
