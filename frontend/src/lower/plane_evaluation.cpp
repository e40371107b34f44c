#include "lower/plane_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "csgcore/stop_scope.hpp"
#include "lower/node_roles.hpp"
#include "plane/hull.hpp"

namespace frontend {
namespace {

using csgcore::FillRule;

constexpr std::string_view kBecauseManyCrossings = "its edges cross too often";

/// Nodes of which OpenSCAD wants 2D children whatever the first one is.
bool wants_plane(NodeKind kind) {
  return kind == NodeKind::kLinearExtrude || kind == NodeKind::kRotateExtrude ||
         kind == NodeKind::kOffset;
}

/// Nodes that need the figures of their operands, and not the operands alone.
bool combines_figures(NodeKind kind) {
  return kind == NodeKind::kHull || kind == NodeKind::kMinkowski || kind == NodeKind::kOffset ||
         kind == NodeKind::kResize || kind == NodeKind::kFill;
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
    const NodeKind kind = subtree_.syntax(i).kind;
    at(i).has_figures = at(i).has_figures || combines_figures(kind);
    if (!at(i).has_figures && kind != NodeKind::kProjection) continue;
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
  if (const ImportedDrawing* drawing = subtree_.drawing(node)) {
    own.dimension = is_extrusion(syntax.kind) && !is_root ? 3 : 2;
    own.presence = drawing->figures.empty() ? Presence::kEmpty : Presence::kSolid;
    return;
  }
  switch (syntax.kind) {
    case NodeKind::kCircle:
    case NodeKind::kSquare:
    case NodeKind::kPolygon:
      own.dimension = 2;
      own.presence = subtree_.data<FigureNode>(node).figure ? Presence::kSolid : Presence::kEmpty;
      return;
    case NodeKind::kText:
      own.dimension = 2;
      own.presence =
          subtree_.data<TextNode>(node).letters.empty() ? Presence::kEmpty : Presence::kSolid;
      return;
    case NodeKind::kSphere:
    case NodeKind::kCylinder:
    case NodeKind::kCube:
    case NodeKind::kPolyhedron:
    case NodeKind::kSurface:
      own.dimension = 3;
      own.presence = Presence::kSolid;
      return;
    case NodeKind::kImport:
      own.dimension = 3;
      own.presence = Presence::kSolid;
      return;
    case NodeKind::kProjection:
      project(node);
      return;
    case NodeKind::kRoof:
      own.presence = Presence::kLeftOut;
      leave_out_(node, kBecauseUnknown);
      return;
    default:
      combine(node);
  }
  if (is_extrusion(syntax.kind) && !is_root) own.dimension = 3;
}

void PlaneEvaluation::combine(uint32_t node) {
  const language::Node& syntax = subtree_.syntax(node);
  Node& own = at(node);
  if (wants_plane(syntax.kind)) own.dimension = 2;
  visit_operands(node, [&](uint32_t child) {
    if (own.dimension == 0) own.dimension = at(child).dimension;
  });
  ignore_other_dimension(node, own.dimension, problems_);
  own.presence = combined_presence(node);
  if (syntax.kind != NodeKind::kMultmatrix || own.presence != Presence::kSolid) return;
  const MatrixNode& matrix = subtree_.data<MatrixNode>(node);
  if (!matrix.is_finite) own.presence = Presence::kEmpty;
  if (own.dimension == 2 && matrix.is_finite && plane_part(matrix.matrix.map).determinant() == 0) {
    own.presence = Presence::kEmpty;
    problems_.add(syntax, {": Scaling a 2D object with 0 - removing object",
                           "only x and y of a matrix act on 2D"});
  }
}

/// Its children are solids, and OpenSCAD does not tell of others that cast no shadow.
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

/// OpenSCAD takes operands of the other dimension for empty ones.
void PlaneEvaluation::ignore_other_dimension(uint32_t node, uint8_t dimension,
                                             NodeProblems& problems) {
  visit_operands(node, [&](uint32_t child) {
    Node& operand = at(child);
    if (operand.dimension == 0 || operand.dimension == dimension) return;
    if (operand.presence == Presence::kSolid) {
      problems.add(subtree_.syntax(child),
                   {dimension == 2 ? ": Ignoring 3D child object for 2D operation"
                                   : ": Ignoring 2D child object for 3D operation",
                    wants_plane(subtree_.syntax(node).kind)
                        ? "it extrudes or moves the outlines of 2D objects"
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

std::optional<std::vector<Figure>> PlaneEvaluation::combined_figures(uint32_t node) {
  switch (subtree_.syntax(node).kind) {
    case NodeKind::kCircle:
    case NodeKind::kSquare:
    case NodeKind::kPolygon:
      return std::vector<Figure>{*subtree_.data<FigureNode>(node).figure};
    case NodeKind::kText: {
      std::vector<Figure> figures;
      for (const PlacedGlyph& letter : subtree_.data<TextNode>(node).letters) {
        figures.push_back(mapped(letter.place, *letter.shape.figure));
      }
      return figures;
    }
    case NodeKind::kDifference:
    case NodeKind::kIntersection:
      return figures_of_operation(node);
    case NodeKind::kMinkowski:
      return figures_of_minkowski(node);
    case NodeKind::kProjection:
      return outcome_of(projection(node));
    case NodeKind::kOffset:
      return offset(union_of_operands(node), subtree_.data<OffsetSettings>(node));
    case NodeKind::kFill:
      return without_holes(union_of_operands(node));
    case NodeKind::kHull: {
      std::vector<Disc> discs;
      for (const Figure& figure : union_of_operands(node)) add_hull_points(figure, discs);
      return std::vector<Figure>{convex_hull(discs)};
    }
    default:
      break;
  }
  std::vector<Figure> figures = union_of_operands(node);
  PlaneMap& map = at(node).map;
  if (subtree_.syntax(node).kind == NodeKind::kMultmatrix) {
    map = plane_part(subtree_.data<MatrixNode>(node).matrix.map);
  } else if (subtree_.syntax(node).kind == NodeKind::kResize) {
    map = map_of_resize(node, figures);
  } else {
    return figures;
  }
  for (Figure& figure : figures) figure = mapped(map, figure);
  return figures;
}

std::optional<std::vector<Figure>> PlaneEvaluation::figures_of_operation(uint32_t node) const {
  std::vector<std::vector<Figure>> operands;
  visit_operands(node, [&](uint32_t child) {
    if (at(child).presence == Presence::kSolid) operands.push_back(at(child).figures);
  });
  if (operands.size() == 1) return operands.front();
  std::vector<SimplePolygons> outlines;
  for (const std::vector<Figure>& operand : operands) {
    std::optional<SimplePolygons> outline = united(operand);
    if (!outline) return std::nullopt;
    outlines.push_back(std::move(*outline));
  }
  std::optional<SimplePolygons> result =
      combined(operation_of(subtree_.syntax(node).kind), outlines);
  if (!result) return std::nullopt;
  return std::vector<Figure>{outline_of(std::move(*result), FillRule::kNonZero)};
}

std::optional<std::vector<Figure>> PlaneEvaluation::figures_of_minkowski(uint32_t node) const {
  std::optional<std::vector<Figure>> sum;
  bool is_first = true;
  visit_operands(node, [&](uint32_t child) {
    const std::vector<Figure>& operand = at(child).figures;
    if (is_first) {
      sum = operand;
      is_first = false;
    } else if (sum && at(child).presence == Presence::kSolid) {
      sum = minkowski_sum(*sum, operand);
    }
  });
  return sum;
}

PlaneMap PlaneEvaluation::map_of_resize(uint32_t node, std::span<const Figure> figures) const {
  Rectangle box;
  for (const Figure& figure : figures) box.merge(bounds_of(figure));
  PlaneMap map;
  if (box.empty()) return map;
  const csgcore::Vec3 factor =
      subtree_.data<ResizeArguments>(node).factors(csgcore::Vec3(box.max - box.min, 0), 2);
  map.linear = glm::dmat2(factor.x, 0, 0, factor.y);
  return map;
}

}  // namespace frontend
