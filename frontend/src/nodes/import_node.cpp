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
    .read = [](NodeReader& reader, const NodeSources& sources) -> NodeData {
      if (names_drawing(reader.tree(), reader.node())) return {};
      return read_import(reader, sources.options.language);
    },
};

}  // namespace frontend
