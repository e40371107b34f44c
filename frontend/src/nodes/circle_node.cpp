#include <algorithm>

#include "arguments/round_node.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {

constexpr language::ArgumentName kCircleLabel[] = {"r"};

FigureNode read_circle(NodeReader& reader, const NodeSources& sources) {
  const auto [sphere, facets] = chosen(sources, read_sphere(reader));
  FigureNode result;
  if (!csgcore::has_valid_shape(sphere)) return result;
  const Disc disc{Vec2(0.0), sphere.as<csgcore::SphereShape>().radius};
  result.fragments = csgcore::fragment_count(disc.radius, facets);
  const bool is_polygon =
      keeps_facets(sources.options, facets) && result.fragments <= kMostFragments;
  result.figure = is_polygon ? Figure(outline_of(Polygons{circle_polygon(disc, result.fragments)}))
                             : Figure(disc);
  result.fragments = std::min(result.fragments, kMostFragments);
  return result;
}

}  // namespace

const NodeRow kCircleRow{
    .role = Role::kWhole,
    .dimension = 2,
    .label = kCircleLabel,
    .read = [](NodeReader& reader, const NodeSources& sources) -> NodeData {
      return read_circle(reader, sources);
    },
};

}  // namespace frontend
