#include "subtrees/extrusions.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "solids/faceted_box.hpp"
#include "solids/sliced_extrusion.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::CsgTree;
using csgcore::CsgTreeBuilder;
using csgcore::Op;
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

/// Extrudes a figure tree.
class Extruding {
 public:
  Extruding(const PlaneSubtree& subtree, PlaneEvaluation& evaluation, uint32_t frame,
            const FrameTree& frames, FigureSolids& solids, NodeProblems& problems)
      : subtree_(subtree),
        evaluation_(evaluation),
        frame_(frame),
        frames_(frames),
        solids_(solids),
        problems_(problems),
        data_(subtree.data<LinearExtrudeNode>(subtree.root())),
        layers_(layers_of(data_.arguments)) {}

  LoweredSubtree lower(const FigureTree& figures) {
    if (layers_.is_twisted() && !is_round(figures)) return lower_slices(figures);
    const Layers layers{layers_.z_min, layers_.z_max, layers_.top_scale.x, lean()};
    return extrude(figures, layers, false, frames_[frame_].to_world, frames_, solids_);
  }

 private:
  Vec2 lean() const { return data_.arguments.lean / data_.arguments.height; }

  /// Returns whether a twist leaves all figures as they are: they are discs about the axis.
  bool is_round(const FigureTree& figures) const {
    return layers_.top_scale.x == layers_.top_scale.y &&
           std::all_of(figures.figures.begin(), figures.figures.end(), [](const auto& placed) {
             const Disc* disc = std::get_if<Disc>(placed.figure.get());
             return disc != nullptr && keeps_circles(placed.map) &&
                    placed.place().point(disc->center) == Vec2(0.0);
           });
  }

  LoweredSubtree lower_slices(const FigureTree& figures) {
    evaluation_.find_all_figures();
    const uint32_t root = subtree_.root();
    std::optional<SlicedExtrusion> solid =
        sliced_extrusion(data_, subtree_.syntax(root), evaluation_.figures(root), problems_);
    LoweredSubtree result;
    if (!solid) return result;
    const Affine to_world = compose(frames_[frame_].to_world, leaning(data_.arguments));
    result.box = mapped(to_world, solid->box);
    std::vector<Primitive> parts = std::move(solid->sheets);
    parts.push_back(std::move(solid->mesh));
    CsgTreeBuilder builder;
    for (Primitive& part : parts) {
      builder.primitive(static_cast<uint32_t>(result.parts.size()));
      part.local_to_world = to_world;
      part.id = figures.figures.front().id;
      result.parts.push_back({std::move(part), frame_, *result.box});
    }
    result.solid = builder.finish();
    return result;
  }

  const PlaneSubtree& subtree_;
  PlaneEvaluation& evaluation_;
  uint32_t frame_;
  const FrameTree& frames_;
  FigureSolids& solids_;
  NodeProblems& problems_;
  const LinearExtrudeNode& data_;
  TwistedLayers layers_;
};

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
        return LoweredSubtree::Part{std::move(*primitive), placed.frame,
                                    mapped(root_to_world, box)};
      });
  result.is_union = is_union(figures.tree) && !whole.empty();
  if (result.is_union) result.box = mapped(root_to_world, whole);
  return result;
}

LoweredSubtree lower_linear_extrude(const PlaneSubtree& subtree, PlaneEvaluation& evaluation,
                                    const FigureTree& figures, uint32_t frame,
                                    const FrameTree& frames, FigureSolids& solids,
                                    NodeProblems& problems) {
  if (!(subtree.data<LinearExtrudeNode>(subtree.root()).arguments.height > 0)) return {};
  return Extruding(subtree, evaluation, frame, frames, solids, problems).lower(figures);
}

}  // namespace frontend
