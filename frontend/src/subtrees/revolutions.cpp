#include "subtrees/revolutions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "heal/matrix_healing.hpp"
#include "language/degrees.hpp"
#include "meshes/face_set.hpp"
#include "solids/faceted_box.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::CsgTreeBuilder;
using csgcore::Op;
using csgcore::Primitive;
using csgcore::Vec3;

/// Revolves a figure tree about the y axis of its plane.
class Revolving {
 public:
  Revolving(const PlaneSubtree& subtree, PlaneEvaluation& evaluation, uint32_t frame,
            const Affine& root_to_world, FigureSolids& solids, NodeProblems& problems)
      : subtree_(subtree),
        evaluation_(evaluation),
        frame_(frame),
        root_to_world_(root_to_world),
        solids_(solids),
        problems_(problems),
        data_(subtree.data<RotateExtrudeNode>(subtree.root())) {}

  LoweredSubtree lower(const FigureTree& figures) {
    LoweredSubtree result;
    const std::optional<Rectangle> reach = reach_of(figures);
    if (!reach || reach->empty()) return result;
    is_left_ = reach->min.x < 0;
    const double radius = is_left_ ? -reach->min.x : reach->max.x;
    sections_ = sections_of(data_.arguments, radius);
    box_ = mapped(root_to_world_, box_of_rings(*reach));
    if (is_union(figures.tree)) result.box = box_;
    if (data_.is_faceted && sections_.count <= kMostSections) {
      lower_mesh(figures, result);
    } else {
      lower_figures(figures, result);
      if (!sections_.is_closed() && !result.solid.empty()) cut(*reach, radius, result);
    }
    return result;
  }

 private:
  /// Returns the bounds of the result in the plane; nothing if it stands on both sides of the axis.
  std::optional<Rectangle> reach_of(const FigureTree& figures) {
    Rectangle reach = positive_bounds(figures);
    if (!(reach.min.x < 0 && reach.max.x > 0)) return reach;
    // What the operations leave may still be on one side.
    evaluation_.find_all_figures();
    const std::optional<SimplePolygons> outline = united(evaluation_.figures(subtree_.root()));
    if (!outline) return std::nullopt;
    return on_one_side(bounds_of(*outline), subtree_.syntax(subtree_.root()), problems_);
  }

  /// Returns the box of the corners that OpenSCAD's rings have.
  Box box_of_rings(const Rectangle& reach) const {
    Box box;
    TurnSections sections = sections_;
    sections.count = std::min(sections.count, kMostSections);
    for (int ring = 0; ring <= sections.count; ++ring) {
      const double azimuth = sections.azimuth(ring);
      const Vec2 direction(language::cosine_of_degrees(azimuth),
                           language::sine_of_degrees(azimuth));
      box.merge(Vec3(reach.min.x * direction, reach.min.y));
      box.merge(Vec3(reach.max.x * direction, reach.max.y));
    }
    return box;
  }

  void lower_figures(const FigureTree& figures, LoweredSubtree& result) const {
    PlaneMap to_right;
    if (is_left_) to_right.linear[0].x = -1;
    Affine place;
    if (is_left_) place = turned_about_z(180);
    result.solid = tree_of_parts(
        figures, result.parts,
        [&](const PlacedFigure& placed) -> std::optional<LoweredSubtree::Part> {
          std::optional<Primitive> primitive =
              solids_.revolved(mapped(compose(to_right, placed.place()), *placed.figure));
          if (!primitive) return std::nullopt;
          primitive->local_to_world =
              compose(compose(root_to_world_, place), primitive->local_to_world);
          return LoweredSubtree::Part{std::move(*primitive), frame_, box_};
        });
  }

  void lower_mesh(const FigureTree& figures, LoweredSubtree& result) {
    evaluation_.find_all_figures();
    std::optional<SimplePolygons> outline = united(evaluation_.figures(subtree_.root()));
    if (!outline || outline->empty()) return;
    const SimplePolygons polygons = cut_at_axis(std::move(*outline), is_left_);
    result.box = mapped(root_to_world_, box_of_rings(bounds_of(polygons)));
    Primitive mesh = revolved_mesh(polygons, sections_);
    std::vector<csgcore::TriangleMesh::Triangle> sheet =
        sheet_of(mesh.mesh()->vertices(), mesh.mesh()->triangles());
    if (!sheet.empty()) {
      const std::span<const Vec3> vertices = mesh.mesh()->vertices();
      mesh = csgcore::make_mesh(std::make_shared<csgcore::TriangleMesh>(
          std::vector<Vec3>(vertices.begin(), vertices.end()), std::move(sheet)));
      problems_.add(subtree_.syntax(subtree_.root()),
                    {" has no volume", "it is drawn as a thin sheet: give it more fragments"});
    }
    mesh.local_to_world = root_to_world_;
    mesh.id = figures.figures.front().id;
    result.parts.push_back({std::move(mesh), frame_, *result.box});
    CsgTreeBuilder builder;
    builder.primitive(0);
    result.solid = builder.finish();
  }

  /// Leaves of a full turn what a partial one reaches.
  void cut(const Rectangle& reach, double radius, LoweredSubtree& result) const {
    const double angle = std::abs(sections_.angle);
    const double first = sections_.start + std::min(sections_.angle, 0.0) + (is_left_ ? 180 : 0);
    const bool is_convex = angle <= 180;
    Primitive wedge =
        solids_.wedge(is_convex ? angle : 360 - angle, radius, reach.min.y, reach.max.y);
    wedge.local_to_world =
        compose(compose(root_to_world_, turned_about_z(is_convex ? first : first + angle)),
                wedge.local_to_world);
    wedge.id = result.parts.front().primitive.id;
    CsgTreeBuilder builder;
    builder.open(is_convex ? Op::kIntersection : Op::kDifference);
    rebuild(result.solid.tokens(), builder,
            [](CsgTreeBuilder& to, uint32_t index) { to.primitive(index); });
    builder.primitive(static_cast<uint32_t>(result.parts.size()));
    builder.close();
    result.solid = builder.finish();
    result.parts.push_back({std::move(wedge), frame_, box_});
  }

  static Affine turned_about_z(double angle) {
    return {euler_rotation(Vec3(0, 0, angle)), Vec3(0.0)};
  }

  const PlaneSubtree& subtree_;
  PlaneEvaluation& evaluation_;
  uint32_t frame_;
  Affine root_to_world_;
  FigureSolids& solids_;
  NodeProblems& problems_;
  const RotateExtrudeNode& data_;
  TurnSections sections_;
  bool is_left_ = false;
  Box box_;
};

}  // namespace

TurnSections sections_of(const RotateExtrudeArguments& arguments, double radius) {
  TurnSections sections;
  sections.angle = arguments.angle;
  const double share = std::abs(arguments.angle) / 360;
  const double count = csgcore::fragment_count(radius, arguments.facets) * share;
  const bool is_fine = arguments.facets.tolerance > 0;
  sections.count = std::max(1, static_cast<int>(is_fine ? std::ceil(count) : count));
  sections.start = arguments.start.value_or(sections.is_closed() ? 180 : 0);
  return sections;
}

std::optional<Rectangle> on_one_side(Rectangle bounds, const Node& node, NodeProblems& problems) {
  if (!(bounds.min.x < 0 && bounds.max.x > 0)) return bounds;
  // OpenSCAD's grid: a figure that reaches less beyond the axis touches it.
  constexpr double kReachBeyondAxis = 0x1p-16;
  if (std::min(-bounds.min.x, bounds.max.x) <= kReachBeyondAxis) {
    (bounds.max.x > -bounds.min.x ? bounds.min.x : bounds.max.x) = 0;
    return bounds;
  }
  std::array<char, 160> text;
  std::snprintf(text.data(), text.size(),
                ": all points for rotate_extrude() must have the same X coordinate sign "
                "(range is %.2f -> %.2f)",
                bounds.min.x, bounds.max.x);
  problems.add(node, {text.data(), "keep the profile on one side of the Y axis"});
  return std::nullopt;
}

SimplePolygons cut_at_axis(SimplePolygons polygons, bool is_left) {
  for (Polygon& polygon : polygons) {
    for (Vec2& point : polygon) {
      point.x = is_left ? std::min(point.x, 0.0) : std::max(point.x, 0.0);
    }
  }
  return polygons;
}

LoweredSubtree lower_rotate_extrude(const PlaneSubtree& subtree, PlaneEvaluation& evaluation,
                                    const FigureTree& figures, uint32_t frame,
                                    const FrameTree& frames, FigureSolids& solids,
                                    NodeProblems& problems) {
  if (subtree.data<RotateExtrudeNode>(subtree.root()).arguments.angle == 0) return {};
  const Affine& root_to_world = frames[frame].to_world;
  return Revolving(subtree, evaluation, frame, root_to_world, solids, problems).lower(figures);
}

}  // namespace frontend
