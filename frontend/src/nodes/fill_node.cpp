#include "plane/outlines.hpp"
#include "subtrees/node_row.hpp"
#include "subtrees/subtree_evaluation.hpp"

namespace frontend {

const NodeRow kFillRow{
    .role = Role::kOperation,
    .is_one_leaf = true,
    .joins_figures = true,
    .figures = [](SubtreeEvaluation& evaluation,
                  uint32_t node) { return without_holes(evaluation.figures_of_operands(node)); },
};

}  // namespace frontend
