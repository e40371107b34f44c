#include "arguments/round_node.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {

namespace {
constexpr language::ArgumentName kSphereLabel[] = {"r"};
}

const NodeRow kSphereRow{
    .role = Role::kSolid,
    .dimension = 3,
    .label = kSphereLabel,
    .read = [](NodeReader& reader, const NodeSources& sources) -> NodeData {
      return chosen(sources, read_sphere(reader));
    },
};

}  // namespace frontend
