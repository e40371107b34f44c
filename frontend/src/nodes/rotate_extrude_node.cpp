#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "language/degrees.hpp"
#include "meshes/face_set.hpp"
#include "solids/faceted_box.hpp"
#include "solids/revolved_solid.hpp"
#include "solids/smooth_slices.hpp"
#include "subtrees/extrusions.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::Op;
using csgcore::Primitive;
using csgcore::Vec3;

constexpr language::ArgumentName kRotateExtrudeLabel[] = {"angle"};

/// More sections cannot be told from a round solid.
constexpr int kMostSections = 3600;

RotateExtrudeArguments read_rotate_extrude(NodeReader& reader) {
  RotateExtrudeArguments result;
  result.facets = reader.facets();
  const std::optional<double> angle = reader.number("angle");
  if (angle && *angle > -360 && *angle <= 360) result.angle = *angle;
  result.start = reader.number("start");
  if (result.start && !std::isfinite(*result.start)) result.start.reset();
  return result;
}

/// Returns how OpenSCAD divides the turn of a figure that reaches so far from the axis.
TurnSections sections_of(const RotateExtrudeArguments& arguments, double radius) {
  TurnSections sections;
  sections.angle = arguments.angle;
  const double share = std::abs(arguments.angle) / 360;
  const double count = csgcore::fragment_count(radius, arguments.facets) * share;
  // 2021.01, which rounds down, knows no start.
  const bool is_rounded_up = arguments.facets.tolerance > 0 || arguments.start;
  sections.count = std::max(1, static_cast<int>(is_rounded_up ? std::ceil(count) : count));
  sections.start = arguments.start.value_or(sections.is_closed() ? 180 : 0);
  return sections;
}

/// Returns the bounds of a figure on one side of the axis x = 0, so that they end there if they
/// reach beyond it by less than a figure's rounding. Nothing if it stands on both sides, which is
/// told.
std::optional<Rectangle> on_one_side(Rectangle bounds, const Extrusion& extrusion) {
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
  extrusion.tell({text.data(), "keep the profile on one side of the Y axis"});
  return std::nullopt;
}

/// Returns the polygons without what is beyond the axis x = 0, which is no more than rounding.
SimplePolygons cut_at_axis(SimplePolygons polygons, bool is_left) {
  for (Polygon& polygon : polygons) {
    for (Vec2& point : polygon) {
      point.x = is_left ? std::min(point.x, 0.0) : std::max(point.x, 0.0);
    }
  }
  return polygons;
}

/// Revolves figures about the y axis of their plane.
class Revolving {
 public:
  explicit Revolving(const Extrusion& extrusion)
      : extrusion_(extrusion),
        to_world_(extrusion.to_world()),
        data_(extrusion.evaluation.data<RotateExtrudeNode>(extrusion.node)) {}

  LoweredSubtree run() {
    LoweredSubtree result;
    if (data_.arguments.angle == 0) return result;
    const std::optional<Rectangle> reach = reach_of_figures();
    if (!reach || reach->empty()) return result;
    is_left_ = reach->min.x < 0;
    const double radius = is_left_ ? -reach->min.x : reach->max.x;
    sections_ = sections_of(data_.arguments, radius);
    box_ = mapped(to_world_, box_of_rings(*reach));
    if (extrusion_.figures.is_union()) result.box = box_;
    if (data_.is_faceted && sections_.count <= kMostSections) {
      add_mesh(united(extrusion_.outcome()), false, result);
    } else if (extrusion_.is_operand && !sections_.is_closed()) {
      sections_.count =
          static_cast<int>(std::ceil(std::abs(sections_.angle) / 360 * kSmoothChords));
      const double size = glm::length(reach->max - reach->min);
      add_mesh(united(extrusion_.outcome(), {kSmoothChords, kSmoothTolerance * size}), true,
               result);
    } else {
      add_figures(result);
      if (!sections_.is_closed() && !result.solid.is_empty()) cut(*reach, radius, result);
    }
    return result;
  }

 private:
  /// Returns the bounds of the result in the plane; nothing if it stands on both sides of the axis.
  std::optional<Rectangle> reach_of_figures() const {
    const Rectangle reach = positive_bounds(extrusion_.figures);
    const bool are_on_one_side = !(reach.min.x < 0 && reach.max.x > 0);
    const bool counts_sections = data_.is_faceted && !extrusion_.figures.is_union();
    if (are_on_one_side && !counts_sections) return reach;
    // What the operations leave may still be on one side, and tells the number of sections.
    const std::optional<SimplePolygons> outline = united(extrusion_.outcome());
    if (!outline) {
      note_crossings();
      return std::nullopt;
    }
    return on_one_side(bounds_of(*outline), extrusion_);
  }

  void note_crossings() const {
    extrusion_.tell(
        {" is left out: its edges cross too often", "let its outline not cross itself"});
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

  void add_figures(LoweredSubtree& result) const {
    PlaneMap to_right;
    if (is_left_) to_right.linear[0].x = -1;
    Affine place;
    if (is_left_) place = turned_about_z(180);
    const auto add = [&](const PlacedFigure& placed, std::vector<SolidPart>& parts) {
      std::optional<Primitive> primitive =
          extrusion_.solids().revolved(mapped(compose(to_right, placed.place()), *placed.figure));
      if (!primitive) return;
      primitive->local_to_world = compose(compose(to_world_, place), primitive->local_to_world);
      parts.push_back(drawn_part(std::move(*primitive), extrusion_.frame, placed.id, box_));
      parts.back().facets = data_.arguments.facets;
    };
    result.solid = replaced<SolidPart>(extrusion_.figures, add);
  }

  /// `is_smooth`: the mesh stands for something round.
  void add_mesh(std::optional<SimplePolygons> outline, bool is_smooth,
                LoweredSubtree& result) const {
    if (!outline) note_crossings();
    if (!outline || outline->empty()) return;
    const SimplePolygons polygons = cut_at_axis(std::move(*outline), is_left_);
    result.box = mapped(to_world_, box_of_rings(bounds_of(polygons)));
    Primitive mesh = revolved_mesh(polygons, sections_);
    std::vector<csgcore::TriangleMesh::Triangle> sheet =
        sheet_of(mesh.mesh()->vertices(), mesh.mesh()->triangles());
    if (!sheet.empty() && !extrusion_.is_operand) {
      const std::span<const Vec3> vertices = mesh.mesh()->vertices();
      mesh = csgcore::make_mesh(std::make_shared<csgcore::TriangleMesh>(
          std::vector<Vec3>(vertices.begin(), vertices.end()), std::move(sheet)));
      extrusion_.tell({" has no volume", "it is drawn as a thin sheet: give it more fragments"});
    }
    mesh.local_to_world = to_world_;
    result.solid =
        value_of(drawn_part(std::move(mesh), extrusion_.frame, extrusion_.id(), *result.box));
    result.solid.parts.front().is_faceted = is_smooth;
  }

  /// Leaves of a full turn what a partial one reaches.
  void cut(const Rectangle& reach, double radius, LoweredSubtree& result) const {
    const double angle = std::abs(sections_.angle);
    const double first = sections_.start + std::min(sections_.angle, 0.0) + (is_left_ ? 180 : 0);
    const bool is_convex = angle <= 180;
    Primitive wedge = extrusion_.solids().wedge(is_convex ? angle : 360 - angle, radius,
                                                reach.min.y, reach.max.y);
    wedge.local_to_world =
        compose(compose(to_world_, turned_about_z(is_convex ? first : first + angle)),
                wedge.local_to_world);
    const uint32_t id = result.solid.parts.front().primitive->id;
    std::vector<SolidValue> operands{std::move(result.solid)};
    operands.push_back(value_of(drawn_part(std::move(wedge), extrusion_.frame, id, box_)));
    result.solid = combined(is_convex ? Op::kIntersection : Op::kDifference, std::move(operands));
  }

  static Affine turned_about_z(double angle) {
    return {euler_rotation(Vec3(0, 0, angle)), Vec3(0.0)};
  }

  const Extrusion& extrusion_;
  Affine to_world_;
  const RotateExtrudeNode& data_;
  TurnSections sections_;
  bool is_left_ = false;
  Box box_;
};

}  // namespace

const NodeRow kRotateExtrudeRow{
    .role = Role::kWhole,
    .dimension = 3,
    .takes_figures = true,
    .label = kRotateExtrudeLabel,
    .read = [](NodeReader& reader, const NodeSources& sources) -> NodeData {
      RotateExtrudeNode result{read_rotate_extrude(reader)};
      result.arguments.facets = chosen(sources, result.arguments.facets);
      result.arguments.facets.tolerance /= 2;  // the figure has the other half
      result.is_faceted = keeps_facets(sources.options, result.arguments.facets);
      return result;
    },
    .solid = solid_of_extrusion,
    .extruded = [](const Extrusion& extrusion) { return Revolving(extrusion).run(); },
};

}  // namespace frontend
