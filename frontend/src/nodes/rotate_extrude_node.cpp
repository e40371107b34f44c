#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "solids/smooth_slices.hpp"
#include "subtrees/node_row.hpp"
#include "subtrees/revolutions.hpp"
#include "subtrees/solid_evaluation.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;

constexpr language::ArgumentName kRotateExtrudeLabel[] = {"angle"};
constexpr std::string_view kBecauseEdgesCross =
    "it holds a rotate_extrude whose edges cross too often";

RotateExtrudeArguments read_rotate_extrude(NodeReader& reader) {
  RotateExtrudeArguments result;
  result.facets = reader.facets();
  const std::optional<double> angle = reader.number("angle");
  if (angle && *angle > -360 && *angle <= 360) result.angle = *angle;
  result.start = reader.number("start");
  if (result.start && !std::isfinite(*result.start)) result.start.reset();
  return result;
}

SolidValue revolved_in(SolidEvaluation& solids, const TurnSections& sections,
                       std::optional<SimplePolygons> outline, bool is_left, bool is_smooth) {
  if (!outline) solids.fail(kBecauseEdgesCross);
  if (!outline || outline->empty()) return {};
  const SimplePolygons polygons = cut_at_axis(std::move(*outline), is_left);
  return value_of(faceted_part(revolved_mesh(polygons, sections), is_smooth));
}

SolidValue revolved(SolidEvaluation& solids, uint32_t node) {
  const RotateExtrudeNode& data = solids.data<RotateExtrudeNode>(node);
  const std::vector<Figure> figures = solids.figures(node);
  Rectangle bounds;
  for (const Figure& figure : figures) bounds.merge(bounds_of(figure));
  if (bounds.empty() || data.arguments.angle == 0) return {};
  const std::optional<Rectangle> reach = on_one_side(bounds, solids.node(node), solids.problems());
  if (!reach) return {};
  const bool is_left = reach->min.x < 0;
  TurnSections sections = sections_of(data.arguments, is_left ? -reach->min.x : reach->max.x);
  if (data.is_faceted && sections.count <= kMostSections) {
    return revolved_in(solids, sections, frontend::united(figures), is_left, false);
  }
  if (!sections.is_closed()) {
    sections.count = static_cast<int>(std::ceil(std::abs(sections.angle) / 360 * kSmoothChords));
    const Chords chords{kSmoothChords, kSmoothTolerance * glm::length(reach->max - reach->min)};
    return revolved_in(solids, sections, frontend::united(figures, chords), is_left, true);
  }
  PlaneMap to_right;
  if (is_left) to_right.linear[0].x = -1;
  std::vector<SolidPart> parts;
  for (const Figure& figure : figures) {
    std::optional<Primitive> primitive = solids.figure_solids().revolved(mapped(to_right, figure));
    if (primitive) parts.push_back(part_of(std::move(*primitive), data.arguments.facets));
  }
  return union_of(std::move(parts));
}

}  // namespace

const NodeRow kRotateExtrudeRow{
    .role = Role::kWhole,
    .dimension = 3,
    .takes_figures = true,
    .label = kRotateExtrudeLabel,
    .read = [](NodeReader& reader, const NodeSources& sources) -> NodeData {
      RotateExtrudeNode result{read_rotate_extrude(reader)};
      result.arguments.facets = chosen(sources, result.arguments.facets);
      result.arguments.facets.tolerance /= 2;  // the figure has the other half
      result.is_faceted = keeps_facets(sources.options, result.arguments.facets);
      return result;
    },
    .solid = revolved,
    .lower = lower_rotate_extrude,
};

}  // namespace frontend
