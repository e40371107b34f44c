#include <algorithm>

#include "subtrees/node_row.hpp"
#include "subtrees/subtree_evaluation.hpp"

namespace frontend {
namespace {

/// Rows and entries that are missing are the identity's.
FileMatrix read_matrix(NodeReader& reader) {
  FileMatrix result;
  result.has_all_digits = reader.tree().has_all_digits;
  const ArgumentValue matrix = reader.find("m", 0);
  if (!matrix.is_list()) {
    reader.tell_wrong_type("the matrix", matrix, "a list of four rows");
    return result;
  }
  const ValueList rows = matrix.elements();
  for (size_t row = 0; row < std::min<size_t>(rows.size(), 4); ++row) {
    if (!rows[row].is_list()) {
      reader.tell_wrong_type("a row of the matrix", rows[row], "a list of four numbers");
      continue;
    }
    const ValueList entries = rows[row].elements();
    for (size_t column = 0; column < std::min<size_t>(entries.size(), 4); ++column) {
      const ArgumentValue entry = entries[column];
      if (!entry.is_number()) {
        reader.tell_wrong_type("an entry of the matrix", entry, "a number");
        continue;
      }
      const int r = static_cast<int>(row);
      const int c = static_cast<int>(column);
      if (row == 3) {
        if (column == 3) result.divisor = entry.number();  // other projective terms are ignored
      } else if (column == 3) {
        result.map.translation[r] = entry.number();
      } else {
        result.map.linear[c][r] = entry.number();
      }
    }
  }
  return result;
}

SolidValue moved(SubtreeEvaluation& evaluation, uint32_t node) {
  SolidValue result = combined(csgcore::Op::kUnion, evaluation.solids_of_operands(node));
  const FileMatrix& file = evaluation.data<FileMatrix>(node);
  if (!is_affine(file)) return {};
  const csgcore::Affine map = heal(file).map;
  for (SolidPart& part : result.parts) part.map(map);
  return result;
}

}  // namespace

const NodeRow kMultmatrixRow{
    .role = Role::kOperation,
    .inner_parts = InnerParts::kOfMembers,
    .read = [](NodeReader& reader, const NodeSources&) -> NodeData { return read_matrix(reader); },
    .figures = [](SubtreeEvaluation& evaluation,
                  uint32_t node) -> std::optional<std::vector<Figure>> {
      return evaluation.moved(evaluation.figures_of_operands(node), node);
    },
    .solid = moved,
};

}  // namespace frontend
