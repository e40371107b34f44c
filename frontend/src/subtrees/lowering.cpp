#include "subtrees/lowering.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "csgcore/stop_scope.hpp"
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

/// Adds a part in its own coordinates as primitives. What cannot be drawn at any scale is beyond
/// double's numbers in places.
void add_pieces(const SolidPart& part, SolidPool& pool, std::vector<SolidPart>& pieces) {
  if (part.primitive) return pieces.push_back(part);
  const Generators& generators = part.body.generators;
  if (!std::all_of(generators.begin(), generators.end(), is_finite)) return;
  ConvexSolid solid = pool.solid(generators);
  auto next = pieces.size();
  pieces.resize(next + solid.pieces.size());
  for (Primitive& piece : solid.pieces) {
    SolidPart& own = pieces[next++];
    own.primitive = std::move(piece);
    own.is_faceted = solid.is_faceted || part.body.is_faceted;
    own.box = part.box;
    own.color = part.color;
  }
}

}  // namespace

LoweredSubtree lower_figures(SubtreeEvaluation& evaluation, Plate plate, uint32_t frame,
                             FrameTree& frames) {
  const uint32_t root = evaluation.root();
  const FigureTree figures = figure_tree(evaluation, root, frame, frames);
  const NodeRow& row = evaluation.row(root);
  if (row.extruded != nullptr) return row.extruded({evaluation, root, figures, frame, frames});
  const auto extruded = [&](const FigureTree& plane, double thickness) {
    return extrude(plane, {-thickness / 2, thickness / 2, 1}, true, frames[frame].to_world, frames,
                   evaluation.sources().figures);
  };
  if (plate == Plate::kFlat) {
    // Without the operations: they may leave so little of large figures that a thin plate of it
    // would be below the renderers' tolerance.
    evaluation.find_all_figures();
    const FigureTree rest = union_of(evaluation.figures(root), frame, figures.parts.front().id);
    return extruded(rest, flat_thickness(rest));
  }
  LoweredSubtree result = extruded(figures, kPlateThickness);
  // OpenSCAD's box is that of what the operations leave.
  if (!result.is_union) {
    evaluation.find_all_figures();
    result.box = box_of(evaluation.figures(root), frames[frame].to_world);
  }
  return result;
}

void thicken_plate(Primitive& part, const Affine& frame_to_world) {
  const Affine to_frame = inverse_of(frame_to_world);
  Affine stretched;
  stretched.linear[2][2] = kSubtractedPlateStretch;
  part.local_to_world =
      compose(frame_to_world, compose(stretched, compose(to_frame, part.local_to_world)));
}

LoweredSubtree lower_solid(const SolidValue& value, const Affine& to_world, uint32_t frame,
                           uint32_t id, SolidPool& pool) {
  LoweredSubtree result;
  result.solid =
      replaced<SolidPart>(value, [&](const SolidPart& part, std::vector<SolidPart>& all) {
        csgcore::stop_point();
        const size_t before = all.size();
        add_pieces(part, pool, all);
        for (SolidPart& piece : std::span(all).subspan(before)) {
          piece.primitive->local_to_world = compose(to_world, piece.primitive->local_to_world);
          piece.primitive->id = id;
          piece.frame = frame;
          piece.box = mapped(to_world, piece.box);
        }
      });
  result.has_operations = !value.is_union();
  if (!result.has_operations) {
    result.box.emplace();
    for (const SolidPart& part : value.parts) result.box->merge(part.box);
    result.box = mapped(to_world, *result.box);
  }
  return result;
}

}  // namespace frontend
