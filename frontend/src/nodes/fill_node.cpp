#include "plane/outlines.hpp"
#include "subtrees/node_row.hpp"
#include "subtrees/plane_evaluation.hpp"

namespace frontend {

const NodeRow kFillRow{
    .role = Role::kOperation,
    .is_one_leaf = true,
    .joins_figures = true,
    .figures = [](PlaneEvaluation& planes,
                  uint32_t node) { return without_holes(planes.union_of_operands(node)); },
};

}  // namespace frontend
