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

LoweredSubtree extrude(const FigureTree& figures, const Layers& layers, bool is_plate,
                       const Affine& root_to_world, const FrameTree& frames, FigureSolids& solids) {
  LoweredSubtree result;
  result.is_plate = is_plate;
  Box whole;  // in the root's coordinates
  result.solid = tree_of_parts(
      figures, result.parts,
      [&](const PlacedFigure& placed) -> std::optional<LoweredSubtree::Part> {
        std::optional<Primitive> primitive =
            solids.extruded(*placed.figure, layers, placed.profile);
        if (!primitive) return std::nullopt;
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
        csgcore::FacetSettings facets;
        facets.fn = placed.fragments;
        return LoweredSubtree::Part{std::move(*primitive), placed.frame, mapped(root_to_world, box),
                                    facets};
      });
  result.is_union = is_union(figures.tree) && !whole.empty();
  if (result.is_union) result.box = mapped(root_to_world, whole);
  return result;
}

LoweredSubtree in_place_of(const Extrusion& extrusion, std::vector<Primitive> solids,
                           const Box& box, const Affine& to_world) {
  LoweredSubtree result;
  result.box = mapped(to_world, box);
  csgcore::CsgTreeBuilder builder;
  for (Primitive& solid : solids) {
    builder.primitive(static_cast<uint32_t>(result.parts.size()));
    solid.local_to_world = compose(to_world, solid.local_to_world);
    solid.id = extrusion.figures.figures.front().id;
    result.parts.push_back({std::move(solid), extrusion.frame, *result.box});
  }
  result.solid = builder.finish();
  return result;
}

}  // namespace frontend
