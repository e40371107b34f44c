#include "lower/plane_subtree.hpp"

#include <algorithm>
#include <cmath>

#include "lower/file_matrix.hpp"
#include "lower/import_arguments.hpp"
#include "lower/node_roles.hpp"

namespace frontend {
namespace {

/// More corners cannot be told from a circle, which then is one.
constexpr int kMostFragments = 3600;

csgcore::FacetSettings chosen(const ImportOptions& options, csgcore::FacetSettings facets) {
  if (options.fn) facets.fn = *options.fn;
  return facets;
}

FigureNode circle_node(const SyntaxTree& tree, const SyntaxNode& node, const ImportOptions& options,
                       NodeProblems& problems) {
  const RoundPrimitive round = read_round_primitive(tree, node, problems);
  const csgcore::FacetSettings facets = chosen(options, round.facets);
  FigureNode result;
  if (!csgcore::has_valid_shape(round.primitive)) return result;
  const Disc disc{Vec2(0.0), round.primitive.r_bottom};
  result.fragments = csgcore::fragment_count(disc.radius, facets);
  const bool is_polygon = keeps_facets(options, facets) && result.fragments <= kMostFragments;
  result.figure = is_polygon ? Figure(outline_of(Polygons{circle_polygon(disc, result.fragments)}))
                             : Figure(disc);
  result.fragments = std::min(result.fragments, kMostFragments);
  return result;
}

FigureNode square_node(const SyntaxTree& tree, const SyntaxNode& node, NodeProblems& problems) {
  const Rectangle box = read_square(tree, node, problems);
  const Vec2 size = box.max - box.min;
  FigureNode result;
  if (!(size.x > 0 && size.y > 0 && std::isfinite(size.x) && std::isfinite(size.y))) return result;
  result.figure =
      outline_of(Polygons{{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}}});
  return result;
}

FigureNode polygon_node(const SyntaxTree& tree, const SyntaxNode& node, NodeProblems& problems) {
  const Figure read = outline_of(read_polygon(tree, node, problems));
  FigureNode result;
  if (std::optional<Polygon> convex = convex_corners(read)) {
    result.figure = outline_of(Polygons{std::move(*convex)});
    return result;
  }
  // Without what is empty, and with what crosses itself cut, as far as that can be afforded.
  std::optional<SimplePolygons> outline = united({&read, 1});
  if (!outline) {
    result.figure = read;
  } else if (!outline->empty()) {
    result.figure = outline_of(std::move(*outline));
  }
  return result;
}

MatrixNode matrix_node(const SyntaxTree& tree, const SyntaxNode& node, NodeProblems& problems) {
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

PlaneNodeData data_of(const SyntaxTree& tree, const SyntaxNode& node, const ImportOptions& options,
                      NodeProblems& problems) {
  switch (node.kind) {
    case NodeKind::kCircle:
      return circle_node(tree, node, options, problems);
    case NodeKind::kSquare:
      return square_node(tree, node, problems);
    case NodeKind::kPolygon:
      return polygon_node(tree, node, problems);
    case NodeKind::kMultmatrix:
      return matrix_node(tree, node, problems);
    case NodeKind::kOffset:
      return offset_settings(read_offset(tree, node), options);
    case NodeKind::kResize:
      return read_resize(tree, node);
    case NodeKind::kLinearExtrude:
      return read_linear_extrude(tree, node, problems);
    case NodeKind::kRotateExtrude: {
      RotateExtrudeNode result{read_rotate_extrude(tree, node)};
      result.arguments.facets = chosen(options, result.arguments.facets);
      result.is_faceted = keeps_facets(options, result.arguments.facets);
      return result;
    }
    case NodeKind::kImport:
      return ImportNode{names_drawing(tree, node)};
    default:
      return std::monostate();
  }
}

}  // namespace

void PlaneSubtree::take(uint32_t node, uint32_t id, const ImportOptions& options,
                        NodeProblems& problems) {
  nodes_.resize(node - root_ + 1);
  const SyntaxNode& syntax = tree_.nodes[node];
  nodes_.back() = {true, id, data_of(tree_, syntax, options, problems),
                   read_solid_node(tree_, syntax, options, problems)};
}

PlaneSubtree PlaneSubtree::part(uint32_t node) const {
  PlaneSubtree result(tree_, node);
  const auto first = nodes_.begin() + (node - root_);
  result.nodes_.assign(first, first + (end_of(node) - node));
  return result;
}

uint32_t PlaneSubtree::first_id(uint32_t node) const {
  while (node + 1 < end_of(node) && !is_primitive_node(syntax(node).kind)) ++node;
  return id(node);
}

uint32_t PlaneSubtree::end_of(uint32_t node) const {
  return std::min(tree_.nodes[node].subtree_end, end());
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
