#include "lower/plane_subtree.hpp"

#include <algorithm>
#include <cmath>

#include "lower/file_matrix.hpp"
#include "lower/import_arguments.hpp"
#include "lower/node_roles.hpp"
#include "lower/read_drawing.hpp"

namespace frontend {
namespace {

/// More corners cannot be told from a circle, which then is one.
constexpr int kMostFragments = 3600;

csgcore::FacetSettings chosen(const ImportOptions& options, csgcore::FacetSettings facets) {
  if (options.fn) facets.fn = *options.fn;
  return facets;
}

FigureNode circle_node(const NodeTree& tree, const Node& node, const ImportOptions& options,
                       NodeProblems& problems) {
  const RoundPrimitive round = read_round_primitive(tree, node, problems);
  const csgcore::FacetSettings facets = chosen(options, round.facets);
  FigureNode result;
  if (!csgcore::has_valid_shape(round.primitive)) return result;
  const Disc disc{Vec2(0.0), round.primitive.as<csgcore::SphereShape>().radius};
  result.fragments = csgcore::fragment_count(disc.radius, facets);
  const bool is_polygon = keeps_facets(options, facets) && result.fragments <= kMostFragments;
  result.figure = is_polygon ? Figure(outline_of(Polygons{circle_polygon(disc, result.fragments)}))
                             : Figure(disc);
  result.fragments = std::min(result.fragments, kMostFragments);
  return result;
}

FigureNode square_node(const NodeTree& tree, const Node& node, NodeProblems& problems) {
  const Rectangle box = read_square(tree, node, problems);
  const Vec2 size = box.max - box.min;
  FigureNode result;
  if (!(size.x > 0 && size.y > 0 && std::isfinite(size.x) && std::isfinite(size.y))) return result;
  result.figure =
      outline_of(Polygons{{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}}});
  return result;
}

FigureNode polygon_node(const NodeTree& tree, const Node& node, NodeProblems& problems) {
  return {cleaned(outline_of(read_polygon(tree, node, problems)))};
}

/// OpenSCAD's chords of a curve in a text; 0: it is kept.
int pieces_of_curves(const NodeTree& tree, const Node& node, double size,
                     const ImportOptions& options) {
  const csgcore::FacetSettings facets = chosen(options, read_facet_settings(tree, node));
  const int fragments = csgcore::fragment_count(size, facets);
  if (!keeps_facets(options, facets) || fragments > kMostFragments) return 0;
  constexpr int kFragmentsOfPiece = 8, kFewestPieces = 2;
  return std::max(kFewestPieces, fragments / kFragmentsOfPiece + 1);
}

TextNode text_node(const NodeTree& tree, const Node& node, const ImportOptions& options,
                   DesignFonts& fonts, NodeProblems& problems) {
  const TextSettings text = read_text(tree, node, problems);
  const int pieces = pieces_of_curves(tree, node, text.size, options);
  return {letters_of(node, text, pieces, fonts, problems)};
}

MatrixNode matrix_node(const NodeTree& tree, const Node& node, NodeProblems& problems) {
  FileMatrix file = read_matrix(tree, node, problems);
  MatrixNode result;
  const csgcore::Affine divided{file.map.linear / file.divisor,
                                file.map.translation / file.divisor};
  result.is_finite = divided.finite();
  if (!result.is_finite) return result;
  file.map = in_space(plane_part(file.map));
  file.map.linear[2][2] = file.divisor;
  result.matrix = heal(file);
  return result;
}

OffsetSettings offset_settings(const OffsetArguments& arguments, const ImportOptions& options) {
  OffsetSettings settings{arguments.distance, arguments.corners, std::nullopt};
  const csgcore::FacetSettings facets = chosen(options, arguments.facets);
  if (keeps_facets(options, facets)) {
    settings.fragments = csgcore::fragment_count(std::abs(arguments.distance), facets);
  }
  return settings;
}

LinearExtrudeNode linear_extrude_node(LinearExtrudeArguments arguments,
                                      const ImportOptions& options) {
  arguments.facets = chosen(options, arguments.facets);
  // Few slices are kept as few fragments are.
  csgcore::FacetSettings asked = arguments.facets;
  if (arguments.slices) asked.fn = *arguments.slices;
  return {arguments, keeps_facets(options, asked)};
}

PlaneNodeData data_of(const NodeTree& tree, const Node& node, const ImportOptions& options,
                      DesignFonts& fonts, NodeProblems& problems) {
  switch (node.kind) {
    case NodeKind::kCircle:
      return circle_node(tree, node, options, problems);
    case NodeKind::kSquare:
      return square_node(tree, node, problems);
    case NodeKind::kPolygon:
      return polygon_node(tree, node, problems);
    case NodeKind::kText:
      return text_node(tree, node, options, fonts, problems);
    case NodeKind::kMultmatrix:
      return matrix_node(tree, node, problems);
    case NodeKind::kOffset:
      return offset_settings(read_offset(tree, node), options);
    case NodeKind::kResize:
      return read_resize(tree, node);
    case NodeKind::kProjection:
      return ProjectionNode{read_cut(tree, node)};
    case NodeKind::kLinearExtrude:
      return linear_extrude_node(read_linear_extrude(tree, node, problems), options);
    case NodeKind::kRotateExtrude: {
      RotateExtrudeNode result{read_rotate_extrude(tree, node)};
      result.arguments.facets = chosen(options, result.arguments.facets);
      result.is_faceted = keeps_facets(options, result.arguments.facets);
      return result;
    }
    default:
      return std::monostate();
  }
}

const ImportedDrawing* drawing_of(const NodeTree& tree, const Node& node,
                                  const ImportOptions& options, FileImports& files,
                                  NodeProblems& problems) {
  if (!names_drawing(tree, node)) return nullptr;
  DrawingArguments arguments = read_drawing_arguments(tree, node, problems);
  arguments.dxf.facets = chosen(options, arguments.dxf.facets);
  arguments.dxf.is_faceted = keeps_facets(options, arguments.dxf.facets);
  // OpenSCAD's chords of an SVG do not depend on $fn: none is meant to be a polygon.
  arguments.svg.is_faceted = options.facets == Facets::kAll;
  const ImportedDrawing& drawing = files.drawing(arguments);
  for (const DrawingProblem& problem : drawing.problems) {
    problems.add(node, {": " + problem.what, problem.todo});
  }
  return &drawing;
}

}  // namespace

void PlaneSubtree::take(uint32_t node, uint32_t id, const ImportOptions& options,
                        const PlaneSources& sources, NodeProblems& problems) {
  nodes_.resize(node - root_ + 1);
  const Node& syntax = tree_.nodes[node];
  nodes_.back() = {id, data_of(tree_, syntax, options, sources.fonts, problems),
                   drawing_of(tree_, syntax, options, sources.files, problems),
                   read_solid_node(tree_, syntax, options, problems)};
}

PlaneSubtree PlaneSubtree::part(uint32_t node) const {
  PlaneSubtree result(tree_, node);
  const auto first = nodes_.begin() + (node - root_);
  result.nodes_.assign(first, first + (end_of(node) - node));
  return result;
}

uint32_t PlaneSubtree::end_of(uint32_t node) const {
  return std::min(tree_.nodes[node].end, end());
}

bool keeps_facets(const ImportOptions& options, const csgcore::FacetSettings& facets) {
  switch (options.facets) {
    case Facets::kNone:
      return false;
    case Facets::kFew:
      return facets.fn > 0 && facets.fn <= options.few_fragments;
    case Facets::kAll:
      return true;
  }
  return false;
}

}  // namespace frontend
