#include <cmath>
#include <optional>

#include "base/geometry_dialect.hpp"
#include "subtrees/node_row.hpp"
#include "subtrees/subtree_evaluation.hpp"

namespace frontend {
namespace {

constexpr language::ArgumentName kOffsetLabel[] = {"r", "delta"};

OffsetSettings read_offset(NodeReader& reader, const NodeSources& sources) {
  OffsetSettings result{1, CornerStyle::kRound, std::nullopt};
  const std::optional<double> r = reader.number("r", 0);
  const std::optional<double> delta = reader.number("delta", 1);
  if (r) {
    result.distance = *r;
  } else if (delta) {
    result.distance = *delta;
    result.corners =
        reader.find("chamfer", 2).is_true() ? CornerStyle::kSquare : CornerStyle::kSharp;
  }
  if (!std::isfinite(result.distance)) result.distance = 0;
  const csgcore::FacetSettings facets = chosen(sources, reader.facets());
  if (keeps_facets(sources.options, facets)) {
    result.fragments = csgcore::fragment_count(std::abs(result.distance), facets);
    result.has_chord_for_rest = GeometryDialect(sources.options.language).has_chord_for_rest;
  }
  return result;
}

}  // namespace

const NodeRow kOffsetRow{
    .role = Role::kWhole,
    .takes_figures = true,
    .joins_figures = true,
    .label = kOffsetLabel,
    .read = [](NodeReader& reader, const NodeSources& sources) -> NodeData {
      return read_offset(reader, sources);
    },
    .figures =
        [](SubtreeEvaluation& evaluation, uint32_t node) {
          return offset(evaluation.figures_of_operands(node),
                        evaluation.data<OffsetSettings>(node));
        },
};

}  // namespace frontend
