#include "lower/solid_evaluation.hpp"

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

#include "base/primitive_traits.hpp"
#include "csgcore/stop_scope.hpp"
#include "hulls/point_hull.hpp"
#include "lower/file_matrix.hpp"
#include "lower/node_roles.hpp"
#include "lower/revolutions.hpp"
#include "lower/sections.hpp"
#include "lower/shadows.hpp"
#include "lower/sliced_extrusion.hpp"
#include "lower/smooth_slices.hpp"
#include "lower/solid_cuts.hpp"
#include "lower/solid_sums.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::Op;
using csgcore::Primitive;
using csgcore::Vec3;

constexpr std::string_view kBecauseEdgesCross =
    "it holds a rotate_extrude whose edges cross too often";

/// Whether a twist leaves the figures as they are.
bool are_round(const std::vector<Figure>& figures, const TwistedLayers& layers) {
  return layers.top_scale.x == layers.top_scale.y &&
         std::all_of(figures.begin(), figures.end(), [](const Figure& figure) {
           const Disc* disc = std::get_if<Disc>(&figure);
           return disc != nullptr && disc->center == Vec2(0.0);
         });
}

/// `is_smooth`: the mesh stands for something round.
SolidPart faceted_part(Primitive mesh, bool is_smooth) {
  SolidPart part = part_of(std::move(mesh), {});
  part.is_faceted = is_smooth;
  return part;
}

/// Bodies of fewer generators are copied, so that generators are in the order of the design:
/// rounding may follow it.
constexpr size_t kManyGenerators = 4096;

/// So few points need not be looked at: to move them takes less.
constexpr size_t kFewPoints = 512;

/// Leaves out points that are no corners of the hull, in the order of the others.
void keep_corners(Generators& generators) {
  std::vector<csgcore::Vec3> points;
  for (const Generator& generator : generators) {
    if (generator.has_disc() || generator.has_ball() || !is_finite(generator)) return;
    points.push_back(generator.center);
  }
  const PointHull hull = point_hull(on_grid(points));
  if (hull.dimension < 3) return;
  Generators corners;
  for (const uint32_t corner : hull.corners) corners.push_back(generators[corner]);
  generators = std::move(corners);
}

/// Returns the operand that is one body of many generators, the largest of several; null: none is.
SolidPart* largest_body(std::vector<SolidValue>& operands) {
  SolidPart* largest = nullptr;
  size_t most = kManyGenerators;
  for (SolidValue& operand : operands) {
    if (operand.parts.size() != 1 || !operand.is_union()) continue;
    SolidPart& part = operand.parts.front();
    if (part.primitive || part.body.generators.size() <= most) continue;
    largest = &part;
    most = part.body.generators.size();
  }
  return largest;
}

}  // namespace

std::optional<SolidValue> SolidEvaluation::run(uint32_t root) {
  first_ = root;
  values_.assign(subtree_.end_of(root) - root, {});
  // Children come after their parents: from the last node on, all that a node holds is known.
  const std::vector<uint32_t> nodes = solid_nodes(root);
  for (auto node = nodes.rbegin(); node != nodes.rend() && failure_.empty(); ++node) {
    csgcore::stop_point();
    values_[*node - root] = evaluate(*node);
  }
  if (!failure_.empty()) return std::nullopt;
  return std::move(values_.front());
}

/// The root, and the nodes of solids below it without those of other projections, whose figures are
/// known.
std::vector<uint32_t> SolidEvaluation::solid_nodes(uint32_t root) const {
  std::vector<uint32_t> result{root};
  for (uint32_t i = root + 1; i < subtree_.end_of(root);) {
    if (subtree_.syntax(i).kind == NodeKind::kProjection) {
      i = subtree_.end_of(i);
      continue;
    }
    if (planes_.presence(i) == Presence::kSolid && planes_.dimension(i) == 3) result.push_back(i);
    ++i;
  }
  return result;
}

std::optional<FigureOperations> SolidEvaluation::projection(uint32_t node) {
  const std::optional<SolidValue> value = run(node);
  if (!value) return std::nullopt;
  if (value->is_empty()) return FigureOperations{};
  return subtree_.data<ProjectionNode>(node).is_cut ? section(node, *value) : shadow(*value);
}

std::optional<FigureOperations> SolidEvaluation::section(uint32_t node, const SolidValue& value) {
  Section section = section_of(value);
  if (section.has_open_mesh) {
    problems_.add(subtree_.syntax(node),
                  {": The given mesh is not closed", "it has no section: close it"});
  } else if (section.operations.is_empty()) {
    problems_.add(subtree_.syntax(node),
                  {": Projection() failed", "nothing meets the plane z = 0"});
  }
  return std::move(section.operations);
}

std::optional<FigureOperations> SolidEvaluation::shadow(const SolidValue& value) {
  Shadows shadows;
  std::optional<FigureOperations> result = shadows.of(value);
  if (!result) fail(shadows.failure());
  return result;
}

void SolidEvaluation::fail(std::string_view why) {
  if (failure_.empty()) failure_ = why;
}

/// Returns the values of the operands that count, in their order; the nodes lose them.
std::vector<SolidValue> SolidEvaluation::operands(uint32_t node) {
  std::vector<SolidValue> result;
  planes_.visit_operands(node, [&](uint32_t child) {
    if (planes_.presence(child) == Presence::kLeftOut) return;
    result.push_back(std::move(values_[child - first_]));
  });
  return result;
}

SolidValue SolidEvaluation::evaluate(uint32_t node) {
  const NodeKind kind = subtree_.syntax(node).kind;
  switch (kind) {
    case NodeKind::kSphere:
    case NodeKind::kCylinder:
    case NodeKind::kCube:
    case NodeKind::kPolyhedron:
    case NodeKind::kImport:
    case NodeKind::kSurface:
      return solid_of_leaf(node);
    case NodeKind::kLinearExtrude:
      return extruded(node);
    case NodeKind::kRotateExtrude:
      return revolved(node);
    case NodeKind::kHull:
      return hull(node);
    case NodeKind::kMinkowski:
      return minkowski(node);
    case NodeKind::kResize:
      return resized(node);
    default:
      break;
  }
  SolidValue result = combined(operation_of(kind), operands(node));
  if (kind == NodeKind::kMultmatrix) {
    const FileMatrix& file = std::get<FileMatrix>(subtree_.solid(node));
    if (!is_affine(file)) return {};
    result.map(heal(file).map);
  }
  return result;
}

SolidValue SolidEvaluation::solid_of_leaf(uint32_t node) {
  const SolidNode& data = subtree_.solid(node);
  if (const auto* round = std::get_if<RoundNode>(&data)) return round_solid(*round);
  if (const auto* box = std::get_if<Box>(&data)) {
    Primitive primitive = sources_.polyhedra.box(*box, {});
    if (!csgcore::has_valid_shape(primitive)) return {};
    return value_of(part_of(std::move(primitive), {}));
  }
  if (const auto* faces = std::get_if<std::shared_ptr<const FaceSet>>(&data)) {
    uint64_t unfinite_faces = 0;  // none: the points are finite
    return solid_of_faces(&sources_.polyhedra.solid(**faces, unfinite_faces));
  }
  return solid_of_faces(solid_of_file(node));
}

SolidValue SolidEvaluation::round_solid(const RoundNode& round) {
  Primitive primitive = round.primitive;
  if (!csgcore::has_valid_shape(primitive)) return {};
  SolidPart part = part_of(primitive, round.facets);
  if (keeps_facets(options_, round.facets)) {
    const int fragments = traits_of(primitive.shape()).fragments(primitive, round.facets);
    if (sources_.polyhedra.facet(primitive, fragments)) part.primitive = std::move(primitive);
  }
  return value_of(std::move(part));
}

const SolidOfFaces* SolidEvaluation::solid_of_file(uint32_t node) {
  const Node& syntax = subtree_.syntax(node);
  const FileArguments& arguments = std::get<FileArguments>(subtree_.solid(node));
  const ImportedFile& file = syntax.kind == NodeKind::kSurface ? sources_.files.surface(arguments)
                                                               : sources_.files.import(arguments);
  if (!file.problem.empty()) {
    problems_.add(syntax, {": " + file.problem, file.todo});
  }
  return file.solid;
}

SolidValue SolidEvaluation::solid_of_faces(const SolidOfFaces* solid) {
  if (solid == nullptr || solid->is_empty()) return {};
  return value_of(part_of(solid->under({}), {}));
}

SolidValue SolidEvaluation::extruded(uint32_t node) {
  const LinearExtrudeNode& data = subtree_.data<LinearExtrudeNode>(node);
  const LinearExtrudeArguments& arguments = data.arguments;
  if (!(arguments.height > 0)) return {};
  const std::vector<Figure> figures = planes_.union_of_operands(node);
  const TwistedLayers layers = layers_of(arguments);
  SolidValue result;
  if (layers.is_twisted() && !are_round(figures, layers)) {
    auto solid = sliced_extrusion(data, subtree_.syntax(node), figures, problems_);
    if (!solid) return {};
    result = value_of(faceted_part(std::move(solid->mesh), !data.is_faceted));
    result.parts.front().box = solid->box;
  } else {
    std::vector<SolidPart> parts;
    for (const Figure& figure : figures) {
      std::optional<Primitive> primitive =
          sources_.figures.extruded(figure, {layers.z_min, layers.z_max, layers.top_scale.x});
      if (primitive) parts.push_back(part_of(std::move(*primitive), {}));
    }
    result = union_of(std::move(parts));
  }
  if (arguments.lean != Vec2(0.0)) result.map(leaning(arguments));
  return result;
}

SolidValue SolidEvaluation::revolved(uint32_t node) {
  const RotateExtrudeNode& data = subtree_.data<RotateExtrudeNode>(node);
  const std::vector<Figure> figures = planes_.union_of_operands(node);
  Rectangle bounds;
  for (const Figure& figure : figures) bounds.merge(bounds_of(figure));
  if (bounds.empty() || data.arguments.angle == 0) return {};
  const std::optional<Rectangle> reach = on_one_side(bounds, subtree_.syntax(node), problems_);
  if (!reach) return {};
  const bool is_left = reach->min.x < 0;
  TurnSections sections = sections_of(data.arguments, is_left ? -reach->min.x : reach->max.x);
  if (data.is_faceted && sections.count <= kMostSections) {
    return revolved_in(sections, frontend::united(figures), is_left, false);
  }
  if (!sections.is_closed()) {
    sections.count = static_cast<int>(std::ceil(std::abs(sections.angle) / 360 * kSmoothChords));
    const Chords chords{kSmoothChords, kSmoothTolerance * glm::length(reach->max - reach->min)};
    return revolved_in(sections, frontend::united(figures, chords), is_left, true);
  }
  PlaneMap to_right;
  if (is_left) to_right.linear[0].x = -1;
  std::vector<SolidPart> parts;
  for (const Figure& figure : figures) {
    std::optional<Primitive> primitive = sources_.figures.revolved(mapped(to_right, figure));
    if (primitive) parts.push_back(part_of(std::move(*primitive), data.arguments.facets));
  }
  return union_of(std::move(parts));
}

SolidValue SolidEvaluation::revolved_in(const TurnSections& sections,
                                        std::optional<SimplePolygons> outline, bool is_left,
                                        bool is_smooth) {
  if (!outline) fail(kBecauseEdgesCross);
  if (!outline || outline->empty()) return {};
  const SimplePolygons polygons = cut_at_axis(std::move(*outline), is_left);
  return value_of(faceted_part(revolved_mesh(polygons, sections), is_smooth));
}

SolidValue SolidEvaluation::hull(uint32_t node) {
  SupportSet support;
  Box box;
  size_t most_before = 0;  // generators of a hull within
  const auto add = [&](const SolidPart& part) {
    most_before = std::max(most_before, part.body.generators.size());
    part.add_support(support);
    box.merge(part.box);
  };
  std::vector<SolidValue> all = operands(node);
  // The largest body is added to: a chain of hulls within hulls copies none at each of them.
  SolidPart* const largest = largest_body(all);
  if (largest != nullptr) {
    most_before = largest->body.generators.size();
    support = std::exchange(largest->body, {});
    box.merge(largest->box);
  }
  for (const SolidValue& operand : all) {
    if (largest != nullptr && operand.parts.data() == largest) continue;
    for (const SolidPart& part : united(operand)) add(part);
  }
  if (support.generators.empty()) return {};
  // Now and then, so that a chain of hulls has no more points than the last of them.
  const bool has_doubled = std::bit_width(support.generators.size()) > std::bit_width(most_before);
  if (most_before > kFewPoints && has_doubled) keep_corners(support.generators);
  return value_of(part_of(std::move(support), box));
}

SolidValue SolidEvaluation::minkowski(uint32_t node) {
  std::vector<SolidValue> all = operands(node);
  std::erase_if(all, [](const SolidValue& value) { return value.is_empty(); });
  if (all.empty()) return {};
  if (all.size() == 1) return std::move(all.front());
  std::vector<SolidPart> result;
  for (const SolidValue& operand : all) {
    // OpenSCAD ignores what is empty.
    std::vector<SolidPart> parts = united(operand);
    if (!failure_.empty()) return {};
    if (parts.empty()) continue;
    if (result.empty()) {
      result = std::move(parts);
      continue;
    }
    // As in OpenSCAD, nothing is left where a sum is flat, whatever comes after it.
    result = sum(result, parts);
    if (result.empty()) return {};
  }
  return union_of(std::move(result));
}

/// Convex parts whose union is the value, as far as that can be found.
std::vector<SolidPart> SolidEvaluation::united(const SolidValue& value) {
  SolidCuts cuts;
  std::vector<SolidPart> parts = cuts.united(value);
  if (!cuts.failure().empty()) fail(cuts.failure());
  return parts;
}

std::vector<SolidPart> SolidEvaluation::sum(const std::vector<SolidPart>& a,
                                            const std::vector<SolidPart>& b) {
  SolidSums sums;
  for (const SolidPart& part : a) {
    for (const SolidPart& other : b) sums.add(part, other);
  }
  if (!sums.failure().empty()) fail(sums.failure());
  return sums.take();
}

SolidValue SolidEvaluation::resized(uint32_t node) {
  SolidValue result = combined(Op::kUnion, operands(node));
  if (result.is_empty()) return {};
  Box box;
  for (const SolidPart& part : united(result)) box.merge(part.box);
  if (box.empty()) return {};
  const Vec3 factors = subtree_.data<ResizeArguments>(node).factors(box.size(), 3);
  Affine map;
  for (int axis = 0; axis < 3; ++axis) map.linear[axis][axis] = factors[axis];
  result.map(map);
  return result;
}

}  // namespace frontend
