// The nodes that say nothing but what becomes of their children.
#include "subtrees/node_row.hpp"
#include "subtrees/subtree_evaluation.hpp"

namespace frontend {
namespace {

using csgcore::Op;

std::optional<std::vector<Figure>> joined(SubtreeEvaluation& evaluation, uint32_t node) {
  std::vector<const std::vector<Figure>*> operands;
  evaluation.visit_operands(node, [&](uint32_t child) {
    if (evaluation.presence(child) == Presence::kSolid)
      operands.push_back(&evaluation.figures(child));
  });
  if (operands.size() == 1) return *operands.front();
  std::vector<SimplePolygons> outlines;
  for (const std::vector<Figure>* operand : operands) {
    std::optional<SimplePolygons> outline = united(*operand);
    if (!outline) return std::nullopt;
    outlines.push_back(std::move(*outline));
  }
  std::optional<SimplePolygons> result = combined(evaluation.row(node).op, outlines);
  if (!result) return std::nullopt;
  return std::vector<Figure>{outline_of(std::move(*result), csgcore::FillRule::kNonZero)};
}

}  // namespace

const NodeRow kGroupRow{.role = Role::kOperation, .inner_parts = InnerParts::kOfMembers};
const NodeRow kUnionRow{.role = Role::kOperation, .inner_parts = InnerParts::kOfMembers};
const NodeRow kRenderRow{.role = Role::kOperation, .is_one_leaf = true};
const NodeRow kDifferenceRow{
    .role = Role::kOperation,
    .op = Op::kDifference,
    .inner_parts = InnerParts::kOwn,
    .figures = joined,
};
const NodeRow kIntersectionRow{
    .role = Role::kOperation,
    .op = Op::kIntersection,
    .inner_parts = InnerParts::kOwn,
    .figures = joined,
};

}  // namespace frontend
