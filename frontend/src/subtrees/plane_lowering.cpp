#include "subtrees/plane_lowering.hpp"

#include <functional>
#include <span>

#include "solids/faceted_box.hpp"
#include "subtrees/extrusions.hpp"
#include "subtrees/figure_tree.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::Primitive;
using csgcore::Vec3;

/// The preview draws a plane figure as a plate about z = 0, whose box it takes for flat.
constexpr double kPlateThickness = 1;
/// A plate that is subtracted is thicker by this factor.
constexpr double kSubtractedPlateStretch = 1.1;

/// Returns the box of figures in the plane z = 0.
Box box_of(std::span<const Figure> figures, const Affine& root_to_world) {
  Box box;
  for (const Figure& figure : figures) {
    const Rectangle bounds = bounds_of(figure);
    if (bounds.empty()) continue;
    box.merge(Vec3(bounds.min, 0));
    box.merge(Vec3(bounds.max, 0));
  }
  return box.empty() ? box : mapped(root_to_world, box);
}

/// Returns a share of the figure's size that is below a pixel.
double flat_thickness(const FigureTree& figures) {
  constexpr double kShare = 0x1p-12;
  const Rectangle bounds = positive_bounds(figures);
  return bounds.empty() ? kPlateThickness : kShare * glm::length(bounds.max - bounds.min);
}

}  // namespace

LoweredSubtree lower_subtree(const PlaneSubtree& subtree, PlaneEvaluation& evaluation, Plate plate,
                             uint32_t frame, FrameTree& frames, FigureSolids& solids,
                             NodeProblems& problems) {
  const uint32_t root = subtree.root();
  const FigureTree figures = figure_tree(subtree, evaluation, root, frame, frames);
  const Affine root_to_world = frames[frame].to_world;
  const std::function<std::span<const Figure>()> outcome = [&] {
    evaluation.find_all_figures();
    return std::span<const Figure>(evaluation.figures(root));
  };
  const NodeRow& row = subtree.row(root);
  if (row.extruded != nullptr) {
    return row.extruded({subtree.syntax(root), subtree.data(root), figures, outcome, frame, frames,
                         solids, problems});
  }
  if (plate == Plate::kFlat) {
    // Without the operations: they may leave so little of large figures that a thin plate of it
    // would be below the renderers' tolerance.
    const FigureTree rest = union_of(outcome(), frame, figures.figures.front().id);
    const double thickness = flat_thickness(rest);
    return extrude(rest, {-thickness / 2, thickness / 2, 1}, true, root_to_world, frames, solids);
  }
  LoweredSubtree result = extrude(figures, {-kPlateThickness / 2, kPlateThickness / 2, 1}, true,
                                  root_to_world, frames, solids);
  // OpenSCAD's box is that of what the operations leave.
  if (!result.is_union) {
    result.box = box_of(outcome(), root_to_world);
  }
  return result;
}

void thicken_plate(Primitive& part, const Affine& frame_to_world) {
  Affine to_frame;
  to_frame.linear = csgcore::inverse(frame_to_world.linear);
  to_frame.translation = -(to_frame.linear * frame_to_world.translation);
  Affine stretched;
  stretched.linear[2][2] = kSubtractedPlateStretch;
  part.local_to_world =
      compose(frame_to_world, compose(stretched, compose(to_frame, part.local_to_world)));
}

}  // namespace frontend
