#include "lower/solid_extrusions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lower/mesh_ends.hpp"
#include "lower/sliced_solid.hpp"
#include "lower/slices.hpp"
#include "lower/smooth_slices.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Primitive;
using csgcore::Vec3;

TwistedLayers layers_of(const LinearExtrudeArguments& arguments) {
  const double z_min = arguments.z_min();
  return {z_min, z_min + arguments.height, arguments.twist, arguments.top_scale};
}

/// Whether a turn about the origin leaves the figures as they are.
bool are_round(std::span<const Figure> figures) {
  return std::all_of(figures.begin(), figures.end(), [](const Figure& figure) {
    const Disc* disc = std::get_if<Disc>(&figure);
    return disc != nullptr && disc->center == Vec2(0.0);
  });
}

Rectangle bounds_of_all(std::span<const Figure> figures) {
  Rectangle bounds;
  for (const Figure& figure : figures) bounds.merge(bounds_of(figure));
  return bounds;
}

std::optional<Primitive> twisted(const LinearExtrudeNode& node, const TwistedLayers& layers,
                                 std::span<const Figure> figures) {
  const LinearExtrudeArguments& given = node.arguments;
  std::optional<SimplePolygons> outline =
      united(figures, chords_of_layers(layers, bounds_of_all(figures), given.slices));
  if (!outline) return std::nullopt;
  const double slices = given.slices ? *given.slices : slice_count(layers, *outline, given.facets);
  return sliced_mesh(layers,
                     node.is_faceted ? openscad_slicing(slices, given.segments, std::move(*outline))
                                     : smooth_slicing(layers, slices, std::move(*outline)),
                     MeshEnds::kExact);
}

}  // namespace

std::optional<std::vector<SolidPart>> extruded_parts(const LinearExtrudeNode& node,
                                                     std::span<const Figure> figures,
                                                     FigureSolids& solids) {
  const LinearExtrudeArguments& given = node.arguments;
  std::vector<SolidPart> parts;
  if (!(given.height > 0) || bounds_of_all(figures).empty()) return parts;
  const TwistedLayers layers = layers_of(given);
  const bool has_plain_scale = given.top_scale.x == given.top_scale.y;
  if (layers.is_twisted() && !(has_plain_scale && are_round(figures))) {
    std::optional<Primitive> mesh = twisted(node, layers, figures);
    if (!mesh) return std::nullopt;
    parts.push_back(part_of(std::move(*mesh), {}));
  } else {
    for (const Figure& figure : figures) {
      std::optional<Primitive> primitive =
          solids.extruded(figure, {layers.z_min, layers.z_max, layers.top_scale.x});
      if (primitive) parts.push_back(part_of(std::move(*primitive), {}));
    }
  }
  if (given.lean == Vec2(0.0)) return parts;
  Affine leaning;
  leaning.linear[2] = Vec3(given.lean / given.height, 1);
  for (SolidPart& part : parts) part.map(leaning);
  return parts;
}

std::optional<std::vector<SolidPart>> revolved_parts(const RotateExtrudeNode& node,
                                                     std::span<const Figure> figures,
                                                     FigureSolids& solids) {
  const RotateExtrudeArguments& given = node.arguments;
  const Rectangle reach = bounds_of_all(figures);
  std::vector<SolidPart> parts;
  if (given.angle == 0 || reach.empty()) return parts;
  if (reach.min.x < 0 && reach.max.x > 0) return std::nullopt;
  TurnSections sections;
  sections.angle = given.angle;
  sections.start = given.start.value_or(sections.is_closed() ? 180 : 0);
  if (sections.is_closed() && !node.is_faceted) {
    PlaneMap to_right;
    if (reach.min.x < 0) to_right.linear[0].x = -1;
    for (const Figure& figure : figures) {
      std::optional<Primitive> primitive = solids.revolved(mapped(to_right, figure));
      if (primitive) parts.push_back(part_of(std::move(*primitive), given.facets));
    }
    return parts;
  }
  const std::optional<SimplePolygons> outline = united(figures);
  if (!outline) return std::nullopt;
  if (outline->empty()) return parts;
  const double radius = std::max(-reach.min.x, reach.max.x);
  const int fragments = csgcore::fragment_count(radius, given.facets);
  const int around = node.is_faceted
                         ? std::min(fragments, kMostSections)
                         : std::max(kChordsOfCircle, std::min(fragments, kMostSections));
  sections.count = std::max(1, static_cast<int>(around * std::abs(given.angle) / 360));
  parts.push_back(part_of(FigureSolids::revolved_mesh(*outline, sections, MeshEnds::kExact), {}));
  return parts;
}

}  // namespace frontend
