#include "lower/import_view_box.hpp"

#include <glm/common.hpp>
#include <limits>
#include <vector>

#include "base/primitive_traits.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::CsgToken;
using csgcore::Op;
using csgcore::Vec3;

Box intersection(const Box& a, const Box& b) {
  return {glm::max(a.min, b.min), glm::min(a.max, b.max)};
}

/// The boxes of all subtrees, in the tokens' order.
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
        if (token.op == Op::kIntersection) result[i] = intersection(result[i], operand);
      }
      operands.resize(first);
    }
    operands.push_back(i);
  }
  return result;
}

/// An operation on the way from the root to a leaf.
struct OpenOperation {
  Op op;
  bool negative;
  uint32_t operands_left;  // the last operand comes first
  Box context;             // where the operands can be seen
};

}  // namespace

Box faceted_box(const csgcore::Primitive& primitive, const csgcore::FacetSettings& settings) {
  const Box local = traits_of(primitive.shape).faceted_box(primitive, settings);
  const csgcore::Affine& map = primitive.local_to_world;
  const Vec3 half = 0.5 * local.size();
  const Vec3 reach = glm::abs(map.linear[0]) * half.x + glm::abs(map.linear[1]) * half.y +
                     glm::abs(map.linear[2]) * half.z;
  const Vec3 center = map.point(local.center());
  return {center - reach, center + reach};
}

Box view_box(const csgcore::CsgTree& tree, std::span<const Box> boxes) {
  const std::span<const CsgToken> tokens = tree.tokens();
  const std::vector<Box> subtree = subtree_boxes(tokens, boxes);
  const Box everywhere{Vec3(-std::numeric_limits<double>::infinity()),
                       Vec3(std::numeric_limits<double>::infinity())};
  Box result;
  std::vector<OpenOperation> open;
  for (size_t i = tokens.size(); i-- > 0;) {
    bool negative = false;
    Box context = everywhere;
    if (!open.empty()) {
      const OpenOperation& parent = open.back();
      const bool subtracted = parent.op == Op::kDifference && parent.operands_left > 1;
      negative = parent.negative != subtracted;
      context = parent.context;
    }
    if (!tokens[i].is_primitive) {
      // A negated intersection is a union of complements: its operands do not bound one another.
      const bool bounds = !negative && tokens[i].op != Op::kUnion;
      open.push_back({tokens[i].op, negative, tokens[i].value,
                      bounds ? intersection(context, subtree[i]) : context});
      continue;
    }
    if (!negative && !intersection(subtree[i], context).empty()) result.merge(subtree[i]);
    while (!open.empty() && --open.back().operands_left == 0) open.pop_back();
  }
  return result;
}

}  // namespace frontend
