#include "lower/plane_lowering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>

#include "heal/matrix_healing.hpp"
#include "lower/faceted_box.hpp"
#include "lower/leaves.hpp"
#include "lower/node_roles.hpp"
#include "lower/read_drawing.hpp"
#include "lower/sliced_solid.hpp"
#include "lower/smooth_slices.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::CsgTree;
using csgcore::CsgTreeBuilder;
using csgcore::Op;
using csgcore::Primitive;
using csgcore::Vec3;

/// The preview draws a plane figure as a plate about z = 0, whose box it takes for flat.
constexpr double kPlateThickness = 1;
/// A plate that is subtracted is thicker by this factor.
constexpr double kSubtractedPlateStretch = 1.1;

/// A figure where it stands in the subtree.
struct PlacedFigure {
  std::shared_ptr<const Figure> figure;
  PlaneMap map;    // of its node, to the root's plane
  uint32_t frame;  // of which the map is the part within the root's
  uint32_t id;
  int fragments = 0;                                  // of a circle: OpenSCAD's
  PlaneMap place_in_node{};                           // of a letter
  std::shared_ptr<const csgcore::Profile> profile{};  // of the figure, where it is made already

  /// To the root's plane.
  PlaneMap place() const { return compose(map, place_in_node); }
};

/// The subtree as operations on figures.
struct FigureTree {
  std::vector<PlacedFigure> figures;
  CsgTree tree;  // over their indices
};

/// Writes the subtree's operations, from the outside in.
class FigureTreeWriter {
 public:
  FigureTreeWriter(const PlaneSubtree& subtree, const PlaneEvaluation& evaluation,
                   uint32_t root_frame, FrameTree& frames)
      : subtree_(subtree), evaluation_(evaluation), frames_(frames) {
    open_.push_back({subtree.end(), root_frame, {}});
  }

  FigureTree write() {
    const bool is_extrusion = frontend::is_extrusion(subtree_.syntax(subtree_.root()).kind);
    if (is_extrusion && subtree_.drawing(subtree_.root()) != nullptr) {
      add_figures(subtree_.root());
      return {std::move(figures_), builder_.finish()};
    }
    for (uint32_t i = subtree_.root() + (is_extrusion ? 1 : 0); i < subtree_.end();) {
      close_until(i);
      i = enter(i);
    }
    close_until(subtree_.end());
    return {std::move(figures_), builder_.finish()};
  }

 private:
  struct Open {
    uint32_t end;
    uint32_t frame;
    PlaneMap map;
  };

  void close_until(uint32_t position) {
    while (open_.size() > 1 && open_.back().end <= position) {
      open_.pop_back();
      builder_.close();
    }
  }

  /// Returns the node to look at next.
  uint32_t enter(uint32_t node) {
    const uint32_t end = subtree_.end_of(node);
    const Presence presence = evaluation_.presence(node);
    if (presence == Presence::kEmpty) builder_.empty();
    if (presence != Presence::kSolid) return end;
    switch (subtree_.syntax(node).kind) {
      case NodeKind::kCircle:
      case NodeKind::kSquare:
      case NodeKind::kPolygon: {
        const FigureNode& data = subtree_.data<FigureNode>(node);
        add(*data.figure, node, data.fragments);
        return end;
      }
      case NodeKind::kText:
        builder_.open(Op::kUnion);
        for (const PlacedGlyph& letter : subtree_.data<TextNode>(node).letters) add(letter, node);
        builder_.close();
        return end;
      case NodeKind::kImport:
      case NodeKind::kHull:
      case NodeKind::kMinkowski:
      case NodeKind::kOffset:
      case NodeKind::kFill:
        add_figures(node);
        return end;
      case NodeKind::kMultmatrix:
        open(node, subtree_.data<MatrixNode>(node).matrix);
        break;
      case NodeKind::kResize: {
        HealedMatrix matrix;
        matrix.map = in_space(evaluation_.resize_map(node));
        open(node, matrix);
        break;
      }
      default:
        builder_.open(operation_of(subtree_.syntax(node).kind));
        open_.push_back({end, open_.back().frame, open_.back().map});
    }
    return node + 1;
  }

  /// All of a node that was evaluated, or of a drawing.
  void add_figures(uint32_t node) {
    const ImportedDrawing* drawing = subtree_.drawing(node);
    const std::span<const Figure> figures =
        drawing != nullptr ? std::span<const Figure>(drawing->figures) : evaluation_.figures(node);
    builder_.open(Op::kUnion);
    for (const Figure& figure : figures) add(figure, node, 0);
    builder_.close();
  }

  void open(uint32_t node, const HealedMatrix& matrix) {
    builder_.open(Op::kUnion);
    open_.push_back({subtree_.end_of(node), frames_.add(open_.back().frame, matrix),
                     compose(open_.back().map, plane_part(matrix.map))});
  }

  void add(const Figure& figure, uint32_t node, int fragments) {
    builder_.primitive(static_cast<uint32_t>(figures_.size()));
    figures_.push_back({std::make_shared<const Figure>(figure), open_.back().map,
                        open_.back().frame, subtree_.first_id(node), fragments});
  }

  void add(const PlacedGlyph& letter, uint32_t node) {
    builder_.primitive(static_cast<uint32_t>(figures_.size()));
    figures_.push_back({letter.shape.figure, open_.back().map, open_.back().frame,
                        subtree_.id(node), 0, letter.place, letter.shape.profile});
  }

  const PlaneSubtree& subtree_;
  const PlaneEvaluation& evaluation_;
  FrameTree& frames_;
  std::vector<Open> open_;
  CsgTreeBuilder builder_;
  std::vector<PlacedFigure> figures_;
};

/// The corners that OpenSCAD has of the figure, in the root's plane.
Rectangle faceted_bounds(const PlacedFigure& placed) {
  if (placed.fragments == 0) return bounds_of(placed.place(), *placed.figure);
  Rectangle result;
  const Rectangle circle = bounds_of(*placed.figure);
  const double radius = std::get_if<Disc>(placed.figure.get()) != nullptr
                            ? std::get<Disc>(*placed.figure).radius
                            : circle.max.x;  // the first corner lies there
  for (const Vec2& corner : circle_polygon({Vec2(0.0), radius}, placed.fragments)) {
    result.merge(placed.map.point(corner));
  }
  return result;
}

/// Gives each figure its solid, where it has one, and writes the tree over those.
template <typename Make>
CsgTree tree_of_parts(const FigureTree& figures, std::vector<LoweredSubtree::Part>& parts,
                      const Make& make) {
  CsgTreeBuilder builder;
  rebuild(figures.tree.tokens(), builder, [&](CsgTreeBuilder& to, uint32_t index) {
    std::optional<LoweredSubtree::Part> part = make(figures.figures[index]);
    if (!part) {
      to.empty();
      return;
    }
    part->primitive.id = figures.figures[index].id;
    to.primitive(static_cast<uint32_t>(parts.size()));
    parts.push_back(std::move(*part));
  });
  return builder.finish();
}

/// What the layers' scaling about the root's origin makes of a figure's place in the plane: its
/// translation grows with z. So it does where they lean.
Affine scaled_place(const PlaneMap& map, const Layers& layers) {
  const double slope = (layers.top_scale - 1) / (layers.z_max - layers.z_min);
  Affine place = in_space(map);
  place.linear[2] = Vec3(slope * map.translation + layers.lean, 1);
  place.translation = Vec3((1 - slope * layers.z_min) * map.translation, 0);
  return place;
}

bool has_operation_but_union(const CsgTree& tree) {
  const auto tokens = tree.tokens();
  return std::any_of(tokens.begin(), tokens.end(), [](const auto& token) {
    return !token.is_primitive && token.op != Op::kUnion;
  });
}

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
  result.is_union = !has_operation_but_union(figures.tree) && !whole.empty();
  if (result.is_union) result.box = mapped(root_to_world, whole);
  return result;
}

/// A solid of more edges is not looked at to find its box: a ray may meet them all.
constexpr size_t kMostLookedAtEdges = 2000;

size_t edge_count(const FigureTree& figures) {
  size_t count = 0;
  for (const PlacedFigure& placed : figures.figures) {
    const Outline* outline = std::get_if<Outline>(placed.figure.get());
    if (outline == nullptr) continue;
    for (const csgcore::ProfileLoop& loop : outline->loops) count += loop.size();
  }
  return count;
}

Box positive_box(const LoweredSubtree& solid) {
  std::vector<Box> boxes;
  for (const LoweredSubtree::Part& part : solid.parts) boxes.push_back(part.box);
  return box_of_positive_leaves(solid.solid, boxes);
}

/// OpenSCAD's box of a plane figure is that of what the operations leave.
Box box_of_rest(PlaneEvaluation& evaluation, uint32_t root, const Affine& root_to_world) {
  evaluation.find_all_figures();
  Box box;
  for (const Figure& figure : evaluation.figures(root)) {
    const Rectangle bounds = bounds_of(figure);
    if (bounds.empty()) continue;
    box.merge(Vec3(bounds.min, 0));
    box.merge(Vec3(bounds.max, 0));
  }
  return box.empty() ? box : mapped(root_to_world, box);
}

/// Bounds of what is not subtracted.
Rectangle positive_bounds(const FigureTree& figures) {
  std::vector<Box> boxes;
  for (const PlacedFigure& placed : figures.figures) {
    const Rectangle bounds = bounds_of(placed.place(), *placed.figure);
    Box& box = boxes.emplace_back();
    if (bounds.empty()) continue;
    box.merge(Vec3(bounds.min, 0));
    box.merge(Vec3(bounds.max, 0));
  }
  const Box box = box_of_positive_leaves(figures.tree, boxes);
  return {Vec2(box.min.x, box.min.y), Vec2(box.max.x, box.max.y)};
}

/// What the operations leave, without them: they may leave so little of large figures that a thin
/// plate of it would be below the renderers' tolerance.
FigureTree evaluated(const FigureTree& figures, PlaneEvaluation& evaluation, uint32_t root,
                     uint32_t frame) {
  evaluation.find_all_figures();
  FigureTree result;
  CsgTreeBuilder builder;
  for (const Figure& figure : evaluation.figures(root)) {
    builder.primitive(static_cast<uint32_t>(result.figures.size()));
    result.figures.push_back(
        {std::make_shared<const Figure>(figure), {}, frame, figures.figures.front().id});
  }
  result.tree = builder.finish();
  return result;
}

/// A share of the figure's size that is below a pixel.
double flat_thickness(const FigureTree& figures) {
  constexpr double kShare = 0x1p-12;
  const Rectangle bounds = positive_bounds(figures);
  return bounds.empty() ? kPlateThickness : kShare * glm::length(bounds.max - bounds.min);
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
        data_(subtree.data<LinearExtrudeNode>(subtree.root())) {
    const LinearExtrudeArguments& given = data_.arguments;
    layers_.z_min = given.is_centered ? -given.height / 2 : 0;
    layers_.z_max = layers_.z_min + given.height;
    layers_.twist = given.twist;
    layers_.top_scale = given.top_scale;
  }

  LoweredSubtree lower(const FigureTree& figures) {
    if (layers_.is_twisted() && !is_round(figures)) return lower_slices(figures);
    const Layers layers{layers_.z_min, layers_.z_max, layers_.top_scale.x, lean()};
    LoweredSubtree solid =
        extrude(figures, layers, false, frames_[frame_].to_world, frames_, solids_);
    if (!solid.is_union && edge_count(figures) > kMostLookedAtEdges)
      solid.box = positive_box(solid);
    return solid;
  }

 private:
  /// Sides that turn need triangles for each chord and each slice. A round outline with flat sides
  /// has as many chords as slices in a turn.
  Chords chords_of(const FigureTree& figures) const {
    const Rectangle bounds = positive_bounds(figures);
    const double reach = std::max(glm::length(bounds.min), glm::length(bounds.max));
    constexpr double kMost = 120;
    if (!has_flat_sides(layers_, reach)) return {static_cast<int>(kMost), kSmoothTolerance * reach};
    const double turns = layers_.turn() / (2 * std::numbers::pi);
    const double slices = data_.arguments.slices.value_or(1) / turns;
    return {static_cast<int>(std::clamp(std::ceil(slices), kMost, double{kChordsOfCircle})), 0};
  }

  Vec2 lean() const { return data_.arguments.lean / data_.arguments.height; }

  /// Whether a twist leaves all figures as they are: they are discs about the axis.
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
    std::optional<SimplePolygons> outline =
        united(evaluation_.figures(subtree_.root()), chords_of(figures));
    if (!outline) {
      problems_.add(subtree_.syntax(subtree_.root()), "crossings", [] {
        return NodeProblems::Description{" is left out: its edges cross too often",
                                         "let its outline not cross itself"};
      });
      return {};
    }
    if (outline->empty()) return {};
    const LinearExtrudeArguments& given = data_.arguments;
    const double slices =
        given.slices ? *given.slices : slice_count(layers_, *outline, given.facets);
    Slicing slicing = openscad_slicing(slices, given.segments, *outline);
    if (slicing.slices < slices) note_fewer(slicing.slices);
    Affine leaning;
    leaning.linear[2] = Vec3(lean(), 1);
    const Affine to_world = compose(frames_[frame_].to_world, leaning);
    const Box box = mapped(to_world, sliced_box(layers_, slicing.slices, *outline));
    const double radius = reach_of(*outline) * layers_.largest_scale();
    if (!data_.is_faceted) slicing = smooth_slicing(layers_, slices, std::move(*outline));
    LoweredSubtree result = cut_at_ends(sliced_mesh(layers_, slicing), radius);
    for (LoweredSubtree::Part& part : result.parts) {
      part.primitive.local_to_world = compose(to_world, part.primitive.local_to_world);
      part.primitive.id = figures.figures.front().id;
      part.frame = frame_;
      part.box = box;
    }
    result.box = box;
    return result;
  }

  void note_fewer(int slices) {
    problems_.add(subtree_.syntax(subtree_.root()), "slices", [&] {
      return NodeProblems::Description{
          " is drawn with " + std::to_string(slices) + " slices: more would be too many triangles",
          "give fewer slices, or a simpler outline"};
    });
  }

  /// Cuts away what the mesh has beyond the ends.
  LoweredSubtree cut_at_ends(Primitive mesh, double radius) const {
    constexpr double kMargin = 1.5;
    const Polygon square = square_of(kMargin * radius);
    LoweredSubtree result;
    CsgTreeBuilder builder;
    builder.open(Op::kIntersection);
    result.parts.push_back({std::move(mesh), frame_, {}});
    std::optional<Primitive> slab =
        solids_.extruded(outline_of(Polygons{square}), {layers_.z_min, layers_.z_max, 1});
    if (slab) result.parts.push_back({std::move(*slab), frame_, {}});
    for (uint32_t i = 0; i < result.parts.size(); ++i) builder.primitive(i);
    builder.close();
    result.solid = builder.finish();
    return result;
  }

  static Polygon square_of(double half) {
    return {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
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
    const double share = std::abs(data_.arguments.angle) / 360;
    sections_.count = std::max(
        1, static_cast<int>(csgcore::fragment_count(radius, data_.arguments.facets) * share));
    sections_.angle = data_.arguments.angle;
    sections_.start = data_.arguments.start.value_or(sections_.is_closed() ? 180 : 0);
    box_ = mapped(root_to_world_, box_of_rings(*reach));
    result.box = box_;
    if (data_.is_faceted && sections_.count <= kMostSections) {
      lower_mesh(figures, result);
    } else {
      lower_figures(figures, result);
    }
    if (!sections_.is_closed() && !result.solid.empty()) cut(*reach, radius, result);
    return result;
  }

 private:
  /// More sections cannot be told from a round solid.
  static constexpr int kMostSections = 3600;
  /// OpenSCAD's grid: a profile that reaches less beyond the axis touches it.
  static constexpr double kReachBeyondAxis = 0x1p-16;

  /// The bounds of the result in the plane; nothing if it stands on both sides of the axis.
  std::optional<Rectangle> reach_of(const FigureTree& figures) {
    Rectangle reach = positive_bounds(figures);
    if (!(reach.min.x < 0 && reach.max.x > 0)) return reach;
    // What the operations leave may still be on one side.
    evaluation_.find_all_figures();
    const std::optional<SimplePolygons> outline = united(evaluation_.figures(subtree_.root()));
    if (!outline) return std::nullopt;
    reach = bounds_of(*outline);
    if (std::min(-reach.min.x, reach.max.x) <= kReachBeyondAxis) {
      (reach.max.x > -reach.min.x ? reach.min.x : reach.max.x) = 0;
      return reach;
    }
    problems_.add(subtree_.syntax(subtree_.root()), "sides", [&] {
      std::array<char, 160> text;
      std::snprintf(text.data(), text.size(),
                    ": all points for rotate_extrude() must have the same X coordinate sign "
                    "(range is %.2f -> %.2f)",
                    reach.min.x, reach.max.x);
      return NodeProblems::Description{text.data(), "keep the profile on one side of the Y axis"};
    });
    return std::nullopt;
  }

  /// The corners that OpenSCAD's rings have.
  Box box_of_rings(const Rectangle& reach) const {
    Box box;
    const int count = std::min(sections_.count, kMostSections);
    for (int ring = 0; ring <= count; ++ring) {
      const double turn = sections_.angle * ring / count;
      const double azimuth = sections_.start + (sections_.is_closed() ? -turn : turn);
      const Vec2 direction(cos_deg(azimuth), sin_deg(azimuth));
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
    for (Polygon& polygon : *outline) {
      for (Vec2& point : polygon) {
        point.x = is_left_ ? std::min(point.x, 0.0) : std::max(point.x, 0.0);
      }
    }
    Primitive mesh = solids_.revolved_mesh(*outline, sections_);
    mesh.local_to_world = root_to_world_;
    mesh.id = figures.figures.front().id;
    result.parts.push_back({std::move(mesh), frame_, box_});
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

LoweredSubtree lower_subtree(const PlaneSubtree& subtree, PlaneEvaluation& evaluation, Plate plate,
                             uint32_t frame, FrameTree& frames, FigureSolids& solids,
                             NodeProblems& problems) {
  const FigureTree figures = FigureTreeWriter(subtree, evaluation, frame, frames).write();
  const Affine root_to_world = frames[frame].to_world;
  const NodeKind kind = subtree.syntax(subtree.root()).kind;
  if (kind == NodeKind::kRotateExtrude) {
    if (subtree.data<RotateExtrudeNode>(subtree.root()).arguments.angle == 0) return {};
    return Revolving(subtree, evaluation, frame, root_to_world, solids, problems).lower(figures);
  }
  if (kind == NodeKind::kLinearExtrude) {
    if (!(subtree.data<LinearExtrudeNode>(subtree.root()).arguments.height > 0)) return {};
    return Extruding(subtree, evaluation, frame, frames, solids, problems).lower(figures);
  }
  if (plate == Plate::kFlat) {
    const FigureTree rest = evaluated(figures, evaluation, subtree.root(), frame);
    const double thickness = flat_thickness(rest);
    return extrude(rest, {-thickness / 2, thickness / 2, 1}, true, root_to_world, frames, solids);
  }
  LoweredSubtree result = extrude(figures, {-kPlateThickness / 2, kPlateThickness / 2, 1}, true,
                                  root_to_world, frames, solids);
  if (!result.is_union) {
    result.box = box_of_rest(evaluation, subtree.root(), root_to_world);
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
