#include "subtrees/plane_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "csgcore/stop_scope.hpp"

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

PlaneEvaluation::PlaneEvaluation(const PlaneSubtree& subtree, NodeProblems& problems,
                                 LeaveOut leave_out, Project project)
    : subtree_(subtree),
      problems_(problems),
      leave_out_(std::move(leave_out)),
      project_(std::move(project)),
      nodes_(subtree.end() - subtree.root()) {
  for (uint32_t i = subtree_.root(); i < subtree_.end(); ++i) {
    at(i).has_figures = at(i).has_figures || row(i).joins_figures;
    const bool is_projection = subtree_.syntax(i).kind == NodeKind::kProjection;
    if (!at(i).has_figures && !is_projection && !is_solid_extrusion(i)) continue;
    for (uint32_t c = i + 1; c < subtree_.end_of(i); c = subtree_.end_of(c)) {
      at(c).has_figures = true;
    }
  }
  // Children come after their parents: from the last node on, all that a node holds is known.
  for (uint32_t i = subtree_.end(); i-- > subtree_.root();) {
    csgcore::stop_point();
    find_presence(i);
    find_figures(i);
  }
}

void PlaneEvaluation::find_presence(uint32_t node) {
  const language::Node& syntax = subtree_.syntax(node);
  const bool is_root = node == subtree_.root();
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

void PlaneEvaluation::combine(uint32_t node) {
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
void PlaneEvaluation::project(uint32_t node) {
  Node& own = at(node);
  own.dimension = 2;
  NodeProblems untold;
  const bool is_cut = subtree_.data<ProjectionNode>(node).is_cut;
  ignore_other_dimension(node, 3, is_cut ? problems_ : untold);
  std::optional<FigureOperations> projection = project_(*this, node);
  if (!projection) {
    own.presence = Presence::kLeftOut;
    return;
  }
  own.presence = projection->is_empty() ? Presence::kEmpty : Presence::kSolid;
  own.projection = std::move(*projection);
}

/// Makes operands of the other dimension empty ones, as OpenSCAD takes them.
void PlaneEvaluation::ignore_other_dimension(uint32_t node, uint8_t dimension,
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

Presence PlaneEvaluation::combined_presence(uint32_t node) const {
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

void PlaneEvaluation::find_all_figures() {
  for (Node& node : nodes_) {
    node.has_figures = true;
    node.figures.clear();
  }
  for (uint32_t i = subtree_.end(); i-- > subtree_.root();) find_figures(i);
}

void PlaneEvaluation::find_figures(uint32_t node) {
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

std::vector<Figure> PlaneEvaluation::union_of_operands(uint32_t node) const {
  if (const ImportedDrawing* drawing = subtree_.drawing(node)) return drawing->figures;
  std::vector<Figure> all;
  visit_operands(node, [&](uint32_t child) {
    const std::vector<Figure>& figures = at(child).figures;
    all.insert(all.end(), figures.begin(), figures.end());
  });
  return all;
}

std::vector<Figure> PlaneEvaluation::moved(std::vector<Figure> figures, uint32_t node) const {
  const PlaneMap map = plane_part(at(node).matrix.map);
  for (Figure& figure : figures) figure = mapped(map, figure);
  return figures;
}

std::optional<std::vector<Figure>> PlaneEvaluation::combined_figures(uint32_t node) {
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
  return row.figures == nullptr ? union_of_operands(node) : row.figures(*this, node);
}

}  // namespace frontend
