#include "subtrees/subtree_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/geometry_dialect.hpp"
#include "base/primitive_traits.hpp"
#include "csgcore/stop_scope.hpp"
#include "solids/sections.hpp"
#include "solids/shadows.hpp"

namespace frontend {
namespace {

constexpr std::string_view kBecauseManyCrossings = "its edges cross too often";

/// Returns whether a node without children is a figure or letters, and those are empty.
bool is_empty_figure(const NodeData& data) {
  const auto* figure = std::get_if<FigureNode>(&data);
  if (figure != nullptr) return !figure->figure;
  return std::holds_alternative<TextNode>(data) && std::get<TextNode>(data).letters.empty();
}

}  // namespace

SubtreeEvaluation::SubtreeEvaluation(const Subtree& subtree, uint32_t root,
                                     const ImportOptions& options, const SolidSources& sources,
                                     NodeProblems& problems, LeaveOut leave_out)
    : subtree_(subtree),
      root_(root),
      options_(options),
      sources_(sources),
      problems_(problems),
      leave_out_(std::move(leave_out)),
      keeps_colors_(GeometryDialect(options.language).keeps_colors),
      nodes_(subtree.end_of(root) - root) {
  const uint32_t end = subtree_.end_of(root_);
  for (uint32_t i = root_; i < end; ++i) {
    at(i).has_figures = at(i).has_figures || row(i).joins_figures;
    const bool is_projection = subtree_.syntax(i).kind == NodeKind::kProjection;
    if (!at(i).has_figures && !is_projection && !is_solid_extrusion(i)) continue;
    for (uint32_t c = i + 1; c < subtree_.end_of(i); c = subtree_.end_of(c)) {
      at(c).has_figures = true;
    }
  }
  // Children come after their parents: from the last node on, all that a node holds is known.
  for (uint32_t i = end; i-- > root_;) {
    csgcore::stop_point();
    find_presence(i);
    find_figures(i);
  }
}

void SubtreeEvaluation::find_presence(uint32_t node) {
  const language::Node& syntax = subtree_.syntax(node);
  const bool is_root = node == root_;
  // The modifiers of the root count where it stands.
  if (!is_root && (syntax.modifiers & language::kBackgroundModifier) != 0) return;
  Node& own = at(node);
  const NodeRow& row = subtree_.row(node);
  if (const ImportedDrawing* drawing = subtree_.drawing(node)) {
    own.dimension = is_solid_extrusion(node) ? 3 : 2;
    own.presence = drawing->figures.empty() ? Presence::kEmpty : Presence::kSolid;
  } else if (syntax.kind == NodeKind::kProjection) {
    project(node);
  } else if (row.is_primitive()) {
    own.dimension = row.dimension;
    own.presence = is_empty_figure(subtree_.data(node)) ? Presence::kEmpty : Presence::kSolid;
  } else {
    combine(node);
    if (is_solid_extrusion(node)) own.dimension = 3;
  }
}

void SubtreeEvaluation::combine(uint32_t node) {
  const language::Node& syntax = subtree_.syntax(node);
  Node& own = at(node);
  if (row(node).takes_figures) own.dimension = 2;
  visit_operands(node, [&](uint32_t child) {
    if (own.dimension == 0) own.dimension = at(child).dimension;
  });
  ignore_other_dimension(node, own.dimension, problems_);
  own.presence = combined_presence(node);
  if (syntax.kind != NodeKind::kMultmatrix || own.presence != Presence::kSolid) return;
  const FileMatrix& file = subtree_.data<FileMatrix>(node);
  if (!is_affine(file)) {
    own.presence = Presence::kEmpty;
  } else if (own.dimension == 2) {
    own.matrix = heal_in_plane(file);
    if (plane_part(own.matrix.map).determinant() != 0) return;
    own.presence = Presence::kEmpty;
    problems_.add(syntax, {": Scaling a 2D object with 0 - removing object",
                           "only x and y of a matrix act on 2D"});
  }
}

/// Finds what a projection makes. Its children are solids, and OpenSCAD does not tell of others
/// that cast no shadow.
void SubtreeEvaluation::project(uint32_t node) {
  Node& own = at(node);
  own.dimension = 2;
  NodeProblems untold;
  const bool is_cut = data<ProjectionNode>(node).is_cut;
  ignore_other_dimension(node, 3, is_cut ? problems_ : untold);
  find_solids(node);
  if (failure_.empty()) own.projection = is_cut ? section(node) : shadow(node);
  if (failure_.empty()) {
    own.presence = own.projection.is_empty() ? Presence::kEmpty : Presence::kSolid;
  } else {
    own.presence = Presence::kLeftOut;
    leave_out_(node, failure_);
  }
}

/// Makes operands of the other dimension empty ones, as OpenSCAD takes them.
void SubtreeEvaluation::ignore_other_dimension(uint32_t node, uint8_t dimension,
                                               NodeProblems& problems) {
  visit_operands(node, [&](uint32_t child) {
    Node& operand = at(child);
    if (operand.dimension == 0 || operand.dimension == dimension) return;
    if (operand.presence == Presence::kSolid) {
      problems.add(subtree_.syntax(child),
                   {dimension == 2 ? ": Ignoring 3D child object for 2D operation"
                                   : ": Ignoring 2D child object for 3D operation",
                    row(node).takes_figures ? "it extrudes or moves the outlines of 2D objects"
                                            : "Mixing 2D and 3D objects is not supported"});
      operand.presence = Presence::kEmpty;
    }
  });
}

Presence SubtreeEvaluation::combined_presence(uint32_t node) const {
  const NodeKind kind = subtree_.syntax(node).kind;
  std::vector<Presence> operands;
  visit_operands(node, [&](uint32_t child) { operands.push_back(at(child).presence); });
  const auto has = [&](Presence wanted) {
    return std::find(operands.begin(), operands.end(), wanted) != operands.end();
  };
  if (operands.empty()) return Presence::kEmpty;
  if (kind == NodeKind::kDifference) return operands.front();
  if (kind == NodeKind::kIntersection && has(Presence::kEmpty)) return Presence::kEmpty;
  if (kind == NodeKind::kMinkowski) {
    // OpenSCAD skips what is empty, but for the first operand and the second of two.
    const bool is_emptied = operands.front() == Presence::kEmpty ||
                            (operands.size() == 2 && operands.back() == Presence::kEmpty);
    if (is_emptied && at(node).dimension == 2) return Presence::kEmpty;
  }
  if (has(Presence::kSolid)) return Presence::kSolid;
  return has(Presence::kLeftOut) ? Presence::kLeftOut : Presence::kEmpty;
}

void SubtreeEvaluation::find_all_figures() {
  for (uint32_t i = subtree_.end_of(root_); i-- > root_;) {
    if (!std::exchange(at(i).has_figures, true)) find_figures(i);
  }
}

void SubtreeEvaluation::find_figures(uint32_t node) {
  const Node& own = at(node);
  if (!own.has_figures || own.presence != Presence::kSolid || own.dimension != 2) return;
  std::optional<std::vector<Figure>> figures = combined_figures(node);
  if (figures) {
    at(node).figures = std::move(*figures);
  } else {
    at(node).presence = Presence::kLeftOut;
    leave_out_(node, kBecauseManyCrossings);
  }
}

std::vector<Figure> SubtreeEvaluation::figures_of_operands(uint32_t node) const {
  if (const ImportedDrawing* drawing = subtree_.drawing(node)) return drawing->figures;
  std::vector<Figure> all;
  visit_operands(node, [&](uint32_t child) {
    const std::vector<Figure>& figures = at(child).figures;
    all.insert(all.end(), figures.begin(), figures.end());
  });
  return all;
}

std::vector<Figure> SubtreeEvaluation::moved(std::vector<Figure> figures, uint32_t node) const {
  const PlaneMap map = plane_part(at(node).matrix.map);
  for (Figure& figure : figures) figure = mapped(map, figure);
  return figures;
}

std::optional<std::vector<Figure>> SubtreeEvaluation::combined_figures(uint32_t node) {
  const NodeData& data = subtree_.data(node);
  if (const auto* figure = std::get_if<FigureNode>(&data)) return std::vector{*figure->figure};
  if (const auto* text = std::get_if<TextNode>(&data)) {
    std::vector<Figure> figures;
    for (const PlacedGlyph& letter : text->letters) {
      figures.push_back(mapped(letter.place, *letter.shape.figure));
    }
    return figures;
  }
  const NodeRow& row = subtree_.row(node);
  return row.figures == nullptr ? figures_of_operands(node) : row.figures(*this, node);
}

std::optional<SolidValue> SubtreeEvaluation::solid() {
  find_solids(root_);
  if (failure_.empty()) return std::move(at(root_).solid);
  leave_out_(root_, failure_);
  return std::nullopt;
}

/// Finds the solid of a node, and on the way those of the nodes that it holds.
void SubtreeEvaluation::find_solids(uint32_t node) {
  failure_ = {};
  const std::vector<uint32_t> nodes = solid_nodes(node);
  for (auto next = nodes.rbegin(); next != nodes.rend() && failure_.empty(); ++next) {
    csgcore::stop_point();
    at(*next).solid = combined_solid(*next);
  }
}

/// Returns the node, and those of solids below it without those of other projections, whose
/// figures are known.
std::vector<uint32_t> SubtreeEvaluation::solid_nodes(uint32_t node) const {
  std::vector<uint32_t> result{node};
  for (uint32_t i = node + 1; i < subtree_.end_of(node);) {
    if (subtree_.syntax(i).kind == NodeKind::kProjection) {
      i = subtree_.end_of(i);
      continue;
    }
    if (at(i).presence == Presence::kSolid && at(i).dimension == 3) result.push_back(i);
    ++i;
  }
  return result;
}

Operations<Figure> SubtreeEvaluation::section(uint32_t node) {
  if (at(node).solid.is_empty()) return {};
  Section section = section_of(at(node).solid);
  if (section.has_open_mesh) {
    problems_.add(subtree_.syntax(node),
                  {": The given mesh is not closed", "it has no section: close it"});
  } else if (section.operations.is_empty()) {
    problems_.add(subtree_.syntax(node),
                  {": Projection() failed", "nothing meets the plane z = 0"});
  }
  return std::move(section.operations);
}

Operations<Figure> SubtreeEvaluation::shadow(uint32_t node) {
  Shadows shadows(sources_.pool);
  std::optional<Operations<Figure>> result = shadows.of(at(node).solid);
  if (!result) fail(shadows.failure());
  return result.value_or(Operations<Figure>{});
}

void SubtreeEvaluation::fail(std::string_view why) {
  if (failure_.empty()) failure_ = why;
}

std::vector<SolidValue> SubtreeEvaluation::solids_of_operands(uint32_t node) {
  std::vector<SolidValue> result;
  visit_operands(node, [&](uint32_t child) {
    if (at(child).presence != Presence::kLeftOut) result.push_back(std::move(at(child).solid));
  });
  return result;
}

SolidValue SubtreeEvaluation::combined_solid(uint32_t node) {
  const NodeRow& row = subtree_.row(node);
  if (row.role == Role::kSolid) return solid_of_leaf(node);
  return row.solid == nullptr ? combined(row.op, solids_of_operands(node)) : row.solid(*this, node);
}

SolidValue SubtreeEvaluation::solid_of_leaf(uint32_t node) {
  std::optional<SolidShape> shape =
      solid_shape(subtree_.data(node), subtree_.syntax(node), sources_, problems_);
  if (!shape || (shape->faces != nullptr && shape->faces->is_empty())) return {};
  SolidPart part = part_of(shape->primitive, shape->facets);
  const int fragments =
      keeps_facets(options_, shape->facets)
          ? traits_of(shape->primitive.shape()).fragments(shape->primitive, shape->facets)
          : 0;
  if (fragments > 0 && sources_.polyhedra.facet(shape->primitive, fragments)) {
    part.primitive = std::move(shape->primitive);
  }
  if (keeps_colors_) part.color = shape->color;
  return value_of(std::move(part));
}

std::vector<SolidPart> SubtreeEvaluation::united(const SolidValue& value, int least_chords) {
  SolidUnion outcome(sources_.pool, least_chords);
  std::vector<SolidPart> parts = outcome.parts_of(value);
  if (!outcome.failure().empty()) fail(outcome.failure());
  return parts;
}

}  // namespace frontend
