#include "subtrees/node_row.hpp"
#include "subtrees/subtree_evaluation.hpp"

namespace frontend {
namespace {
constexpr language::ArgumentName kProjectionLabel[] = {"cut"};
}

const NodeRow kProjectionRow{
    .role = Role::kWhole,
    .dimension = 2,
    .label = kProjectionLabel,
    .read = [](NodeReader& reader, const NodeSources&) -> NodeData {
      return ProjectionNode{reader.is_true("cut", 0)};
    },
    .figures = [](SubtreeEvaluation& evaluation,
                  uint32_t node) { return outcome_of(evaluation.projection(node)); },
};

}  // namespace frontend
