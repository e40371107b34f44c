#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/angles.hpp"
#include "csgcore/facets.hpp"
#include "plane/roof.hpp"
#include "solids/faceted_box.hpp"
#include "solids/roof_solid.hpp"
#include "solids/smooth_slices.hpp"
#include "subtrees/extrusions.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {

constexpr language::ArgumentName kRoofLabel[] = {"method"};

RoofNode read_roof(NodeReader& reader, const NodeSources& sources) {
  RoofNode result;
  const std::string_view method = reader.text("method", 0);
  result.is_straight = method == "straight";
  if (!method.empty() && !result.is_straight && method != "voronoi") {
    reader.tell_wrong("method", '"' + std::string(method) + '"', "counts as \"voronoi\"",
                      "\"voronoi\" or \"straight\"");
  }
  result.facets = chosen(sources, reader.facets());
  result.facets.tolerance /= 2;  // the figure has the other half
  result.is_faceted = keeps_facets(sources.options, result.facets);
  return result;
}

/// Returns the most by which the tangent planes of a cone are turned against each other.
double bevel_step_of(const RoofNode& roof, const Rectangle& bounds) {
  if (roof.is_straight) return 0;
  if (!roof.is_faceted) return kTurn / kSmoothChords;
  // No cone is higher than half of the smaller side.
  const Vec2 size = bounds.max - bounds.min;
  return kTurn / csgcore::fragment_count(std::min(size.x, size.y) / 2, roof.facets);
}

/// Returns the cone over a disc.
LoweredSubtree roofed_disc(const Disc& disc, const Extrusion& extrusion) {
  const csgcore::Vec3 center(disc.center, 0);
  csgcore::Box box;
  box.merge(center - csgcore::Vec3(disc.radius, disc.radius, 0));
  box.merge(center + csgcore::Vec3(disc.radius));
  csgcore::Affine place;
  place.translation = center;
  return in_place_of(extrusion, {csgcore::make_frustum(0, disc.radius, disc.radius, 0, place)}, box,
                     extrusion.to_world(), false);
}

LoweredSubtree roofed(const Extrusion& extrusion) {
  const auto& data = extrusion.evaluation.data<RoofNode>(extrusion.node);
  const std::vector<Figure> figures = extrusion.outcome();
  const Disc* disc = figures.size() == 1 ? std::get_if<Disc>(&figures.front()) : nullptr;
  if (disc != nullptr && disc->radius > 0) return roofed_disc(*disc, extrusion);
  Rectangle bounds;
  for (const Figure& figure : figures) bounds.merge(bounds_of(figure));
  if (bounds.empty()) return {};
  const double reach = glm::length(bounds.max - bounds.min) / 2;
  const std::optional<SimplePolygons> outline =
      united(figures, {kSmoothChords, kSmoothTolerance * reach});
  if (!outline) {
    extrusion.tell({" is left out: its edges cross too often", "let its outline not cross itself"});
    return {};
  }
  const std::optional<Roof> roof = roof_over(*outline, bevel_step_of(data, bounds));
  if (!roof) {
    extrusion.tell(
        {" is left out: Skeleton computation error", "let no corners of its outline nearly touch"});
    return {};
  }
  if (roof->ends.empty()) return {};
  csgcore::Box box;
  for (const csgcore::Vec3& point : roof->points) box.merge(point);
  const bool is_round = roof->bevel_count > 0 || !std::ranges::all_of(figures, is_polygonal);
  return in_place_of(extrusion, {roof_mesh(*roof)}, box, extrusion.to_world(),
                     extrusion.is_operand && is_round && !data.is_faceted);
}

}  // namespace

const NodeRow kRoofRow{
    .role = Role::kWhole,
    .dimension = 3,
    .takes_figures = true,
    .label = kRoofLabel,
    .read = [](NodeReader& reader, const NodeSources& sources) -> NodeData {
      return read_roof(reader, sources);
    },
    .solid = solid_of_extrusion,
    .extruded = roofed,
};

}  // namespace frontend
