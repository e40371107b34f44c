#include "lower/plane_evaluation.hpp"
#include "nodes/node_row.hpp"
#include "plane/outlines.hpp"

namespace frontend {

const NodeRow kFillRow{
    .role = Role::kOperation,
    .is_one_leaf = true,
    .joins_figures = true,
    .figures = [](PlaneEvaluation& planes, uint32_t node) {
      return without_holes(planes.union_of_operands(node));
    },
};

}  // namespace frontend
