#include "arguments/round_node.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {
constexpr language::ArgumentName kCylinderLabel[] = {"h", "r1", "r2"};
}

const NodeRow kCylinderRow{
    .role = Role::kSolid,
    .dimension = 3,
    .label = kCylinderLabel,
    .read = [](NodeReader& reader, const NodeSources& sources) -> NodeData {
      return chosen(sources, read_cylinder(reader));
    },
};

}  // namespace frontend
