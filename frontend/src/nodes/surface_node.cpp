#include "arguments/file_arguments.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {
constexpr language::ArgumentName kSurfaceLabel[] = {"file"};
}

const NodeRow kSurfaceRow{
    .role = Role::kSolid,
    .dimension = 3,
    .label = kSurfaceLabel,
    .read = [](NodeReader& reader, const NodeSources&) -> NodeData { return read_surface(reader); },
};

}  // namespace frontend
