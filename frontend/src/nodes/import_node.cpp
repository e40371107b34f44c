#include "arguments/file_arguments.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {
constexpr language::ArgumentName kImportLabel[] = {"file"};
}

const NodeRow kImportRow{
    .role = Role::kSolid,
    .dimension = 3,
    .label = kImportLabel,
    .read = [](NodeReader& reader, const NodeSources&) -> NodeData {
      return names_drawing(reader.tree(), reader.node()) ? NodeData() : read_import(reader);
    },
};

}  // namespace frontend
