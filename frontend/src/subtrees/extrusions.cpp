#include "subtrees/extrusions.hpp"

#include <optional>
#include <utility>

#include "solids/faceted_box.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::Primitive;
using csgcore::Vec3;

/// What the layers' scaling about the root's origin makes of a figure's place in the plane: its
/// translation grows with z. So it does where they lean.
Affine scaled_place(const PlaneMap& map, const Layers& layers) {
  const double slope = (layers.top_scale - 1) / (layers.z_max - layers.z_min);
  Affine place = in_space(map);
  place.linear[2] = Vec3(slope * map.translation + layers.lean, 1);
  place.translation = Vec3((1 - slope * layers.z_min) * map.translation, 0);
  return place;
}

}  // namespace

SolidPart drawn_part(Primitive&& primitive, uint32_t frame, uint32_t id, const Box& box) {
  SolidPart part;
  part.primitive = std::move(primitive);
  part.primitive->id = id;
  part.frame = frame;
  part.box = box;
  return part;
}

std::vector<Figure> Extrusion::outcome() const {
  if (!is_operand) evaluation.find_all_figures();
  return evaluation.figures_of_operands(node);
}

LoweredSubtree extrude(const FigureTree& figures, const Layers& layers, bool is_plate,
                       const Affine& root_to_world, const FrameTree& frames, FigureSolids& solids) {
  LoweredSubtree result;
  result.is_plate = is_plate;
  Box whole;  // in the root's coordinates
  const auto add = [&](const PlacedFigure& placed, std::vector<SolidPart>& parts) {
    std::optional<Primitive> primitive = solids.extruded(*placed.figure, layers, placed.profile);
    if (!primitive) return;
    const bool is_upright = layers.top_scale == 1 && layers.lean == Vec2(0.0);
    const Affine to_world =
        is_upright ? compose(frames[placed.frame].to_world, in_space(placed.place_in_node))
                   : compose(root_to_world, scaled_place(placed.place(), layers));
    primitive->local_to_world = compose(to_world, primitive->local_to_world);
    const Rectangle bounds = faceted_bounds(placed);
    Box box;
    for (const Vec2& corner : {bounds.min, bounds.max}) {
      box.merge(Vec3(corner + layers.z_min * layers.lean, is_plate ? 0 : layers.z_min));
      box.merge(Vec3(layers.top_scale * corner + layers.z_max * layers.lean,
                     is_plate ? 0 : layers.z_max));
    }
    whole.merge(box);
    parts.push_back(
        drawn_part(std::move(*primitive), placed.frame, placed.id, mapped(root_to_world, box)));
    parts.back().facets.fn = placed.fragments;
  };
  result.solid = replaced<SolidPart>(figures, add);
  result.is_union = figures.is_union() && !whole.empty();
  if (result.is_union) result.box = mapped(root_to_world, whole);
  return result;
}

LoweredSubtree in_place_of(const Extrusion& extrusion, std::vector<Primitive> solids,
                           const Box& box, const Affine& to_world, bool is_smooth) {
  LoweredSubtree result;
  result.box = mapped(to_world, box);
  std::vector<SolidPart> parts;
  for (Primitive& solid : solids) {
    solid.local_to_world = compose(to_world, solid.local_to_world);
    parts.push_back(drawn_part(std::move(solid), extrusion.frame, extrusion.id(), *result.box));
    parts.back().is_faceted = is_smooth;
  }
  result.solid = union_of(std::move(parts));
  return result;
}

SolidValue solid_of_extrusion(SubtreeEvaluation& evaluation, uint32_t node) {
  FrameTree frames;
  FigureTree figures = figure_tree(evaluation, node, 0, frames);
  if (figures.parts.empty()) return {};
  // What is needed is the surface: operations are done in the plane.
  if (!figures.is_union()) {
    figures = union_of(evaluation.figures_of_operands(node), 0, evaluation.subtree().id(node));
  }
  return evaluation.row(node).extruded({evaluation, node, figures, 0, frames, true}).solid;
}

}  // namespace frontend
