#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "arguments/value_text.hpp"
#include "base/geometry_dialect.hpp"
#include "solids/faceted_box.hpp"
#include "solids/sliced_extrusion.hpp"
#include "subtrees/extrusions.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;

constexpr language::ArgumentName kLinearExtrudeLabel[] = {"height", "twist", "scale"};

/// A number of at least `least`, without its fraction.
std::optional<double> count_of(NodeReader& reader, language::ArgumentName name, double least) {
  const std::optional<double> value = reader.number(name);
  if (!value || !(*value >= least) || !std::isfinite(*value)) return std::nullopt;
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
  arguments.cuts_edges = GeometryDialect(options.language).cuts_twisted_edges;
  // Few slices are kept as few fragments are.
  csgcore::FacetSettings asked = arguments.facets;
  if (arguments.slices) asked.fn = *arguments.slices;
  const bool is_surface =
      options.facets == Facets::kAll && options.picture == PictureKind::kRendered;
  return {arguments, keeps_facets(options, asked), is_surface};
}

/// Returns whether a twist leaves all figures as they are: they are discs about the axis.
bool are_round(const std::vector<PlacedFigure>& figures, const TwistedLayers& layers) {
  return layers.top_scale.x == layers.top_scale.y &&
         std::all_of(figures.begin(), figures.end(), [](const PlacedFigure& placed) {
           const Disc* disc = std::get_if<Disc>(placed.figure.get());
           return disc != nullptr && keeps_circles(placed.map) &&
                  placed.place().point(disc->center) == Vec2(0.0);
         });
}

LoweredSubtree sliced(const Extrusion& extrusion) {
  const auto& data = extrusion.evaluation.data<LinearExtrudeNode>(extrusion.node);
  std::optional<SlicedExtrusion> solid = sliced_extrusion(
      data, extrusion.syntax(), extrusion.outcome(), extrusion.evaluation.problems());
  if (!solid) return {};
  std::vector<Primitive> parts;
  if (!extrusion.is_operand) parts = std::move(solid->sheets);
  parts.push_back(std::move(solid->mesh));
  return in_place_of(extrusion, std::move(parts), solid->box,
                     compose(extrusion.to_world(), leaning(data.arguments)),
                     extrusion.is_operand && !data.is_faceted);
}

/// Returns the figures to extrude, as one where the node unites them and they can be united.
FigureTree figures_to_extrude(const Extrusion& extrusion) {
  const FigureTree& figures = extrusion.figures;
  const auto& data = extrusion.evaluation.data<LinearExtrudeNode>(extrusion.node);
  if (!data.unites_figures || figures.parts.size() < 2) return figures;
  std::optional<SimplePolygons> polygons = united(extrusion.outcome());
  if (!polygons) return figures;
  const Figure whole = outline_of(std::move(*polygons), csgcore::FillRule::kNonZero);
  return union_of({&whole, 1}, extrusion.frame, extrusion.id());
}

LoweredSubtree extruded(const Extrusion& extrusion) {
  const LinearExtrudeArguments& arguments =
      extrusion.evaluation.data<LinearExtrudeNode>(extrusion.node).arguments;
  if (!(arguments.height > 0)) return {};
  const TwistedLayers layers = layers_of(arguments);
  if (layers.is_twisted() && !are_round(extrusion.figures.parts, layers)) {
    return sliced(extrusion);
  }
  return extrude(
      figures_to_extrude(extrusion),
      {layers.z_min, layers.z_max, layers.top_scale.x, arguments.lean / arguments.height}, false,
      extrusion.to_world(), extrusion.frames, extrusion.solids());
}

LinearExtrudeArguments read_linear_extrude(NodeReader& reader) {
  LinearExtrudeArguments result;
  result.facets = reader.facets();
  read_height(reader, result);
  result.is_centered = reader.center();
  const double twist = reader.number("twist").value_or(0);
  if (std::isfinite(twist)) result.twist = twist;
  result.top_scale = read_top_scale(reader);
  result.slices = count_of(reader, "slices", 1);
  result.segments = count_of(reader, "segments", 0);
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
    .solid = solid_of_extrusion,
    .extruded = extruded,
};

}  // namespace frontend
