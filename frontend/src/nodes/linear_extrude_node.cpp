#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "arguments/value_text.hpp"
#include "solids/sliced_extrusion.hpp"
#include "subtrees/extrusions.hpp"
#include "subtrees/node_row.hpp"
#include "subtrees/solid_evaluation.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;

constexpr language::ArgumentName kLinearExtrudeLabel[] = {"height", "twist", "scale"};

/// A number of at least 1, without its fraction.
std::optional<double> count_of(NodeReader& reader, language::ArgumentName name) {
  const std::optional<double> value = reader.number(name);
  if (!value || !(*value >= 1) || !std::isfinite(*value)) return std::nullopt;
  return std::trunc(*value);
}

/// Three finite numbers.
std::optional<std::array<double, 3>> triple_of(const ArgumentValue& value) {
  if (!value.is_list() || value.elements().size() != 3) return std::nullopt;
  std::array<double, 3> result{};
  for (size_t i = 0; i < result.size(); ++i) {
    const ArgumentValue element = value.elements()[i];
    if (!element.is_number() || !std::isfinite(element.number())) return std::nullopt;
    result[i] = element.number();
  }
  return result;
}

/// Height and direction. A direction alone is as long as the extrusion; with a height it is the
/// direction only.
void read_height(NodeReader& reader, LinearExtrudeArguments& result) {
  std::optional<double> height = reader.number("height", 0);
  if (!height) height = reader.number("h");
  if (height && std::isfinite(*height)) result.height = *height;
  const auto direction = triple_of(reader.find("v"));
  if (!direction) return;
  const auto [x, y, z] = *direction;
  const double length = std::hypot(x, y, z);
  const double share = height && length > 0 ? result.height / length : 1;
  result.height = share * z;
  result.lean = share * Vec2(x, y);
}

Vec2 read_top_scale(NodeReader& reader) {
  Vec2 scale(1.0);
  const ArgumentValue given = reader.find("scale");
  if (given.is_number()) scale = Vec2(given.number());
  scale = pair_of(given).value_or(scale);
  for (int axis = 0; axis < 2; ++axis) {
    scale[axis] = std::isfinite(scale[axis]) ? std::max(scale[axis], 0.0) : 1;
  }
  return scale;
}

LinearExtrudeNode linear_extrude_node(LinearExtrudeArguments arguments,
                                      const ImportOptions& options) {
  arguments.facets = chosen(options, arguments.facets);
  // Few slices are kept as few fragments are.
  csgcore::FacetSettings asked = arguments.facets;
  if (arguments.slices) asked.fn = *arguments.slices;
  return {arguments, keeps_facets(options, asked)};
}

/// Returns whether a twist leaves the figures as they are.
bool are_round(const std::vector<Figure>& figures, const TwistedLayers& layers) {
  return layers.top_scale.x == layers.top_scale.y &&
         std::all_of(figures.begin(), figures.end(), [](const Figure& figure) {
           const Disc* disc = std::get_if<Disc>(&figure);
           return disc != nullptr && disc->center == Vec2(0.0);
         });
}

SolidValue extruded(SolidEvaluation& solids, uint32_t node) {
  const LinearExtrudeNode& data = solids.data<LinearExtrudeNode>(node);
  const LinearExtrudeArguments& arguments = data.arguments;
  if (!(arguments.height > 0)) return {};
  const std::vector<Figure> figures = solids.figures(node);
  const TwistedLayers layers = layers_of(arguments);
  SolidValue result;
  if (layers.is_twisted() && !are_round(figures, layers)) {
    auto solid = sliced_extrusion(data, solids.node(node), figures, solids.problems());
    if (!solid) return {};
    result = value_of(faceted_part(std::move(solid->mesh), !data.is_faceted));
    result.parts.front().box = solid->box;
  } else {
    std::vector<SolidPart> parts;
    for (const Figure& figure : figures) {
      std::optional<Primitive> primitive =
          solids.figure_solids().extruded(figure, {layers.z_min, layers.z_max, layers.top_scale.x});
      if (primitive) parts.push_back(part_of(std::move(*primitive), {}));
    }
    result = union_of(std::move(parts));
  }
  if (arguments.lean != Vec2(0.0)) result.map(leaning(arguments));
  return result;
}

LinearExtrudeArguments read_linear_extrude(NodeReader& reader) {
  LinearExtrudeArguments result;
  result.facets = reader.facets();
  read_height(reader, result);
  result.is_centered = reader.center();
  const double twist = reader.number("twist").value_or(0);
  if (std::isfinite(twist)) result.twist = twist;
  result.top_scale = read_top_scale(reader);
  result.slices = count_of(reader, "slices");
  result.segments = count_of(reader, "segments");
  return result;
}

}  // namespace

const NodeRow kLinearExtrudeRow{
    .role = Role::kWhole,
    .dimension = 3,
    .takes_figures = true,
    .label = kLinearExtrudeLabel,
    .read = [](NodeReader& reader, const NodeSources& sources) -> NodeData {
      return linear_extrude_node(read_linear_extrude(reader), sources.options);
    },
    .solid = extruded,
    .lower = lower_linear_extrude,
};

}  // namespace frontend
