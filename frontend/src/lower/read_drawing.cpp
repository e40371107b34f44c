#include "lower/read_drawing.hpp"

#include <optional>
#include <span>
#include <string_view>

#include "base/lower_case.hpp"
#include "lower/argument_lookup.hpp"
#include "lower/node_roles.hpp"
#include "lower/read_2d.hpp"

namespace frontend {
namespace {

/// Returns the name of the node's file; empty if it is missing.
std::string_view file_of(const NodeTree& tree, const Node& node) {
  const size_t position = is_extrusion(node.kind) ? kByNameOnly : 0;
  const ArgumentValue file = find_argument(tree, node, "file", position);
  return file.is_string() ? file.text() : "";
}

/// The number, or the first of a list: an extrusion's `scale` scales its drawing, too.
std::optional<double> first_number(const NodeTree& tree, const Node& node,
                                   language::ArgumentName name) {
  ArgumentValue value = find_argument(tree, node, name);
  if (value.is_list() && !value.elements().empty()) value = value.elements()[0];
  if (!value.is_number()) return std::nullopt;
  return value.number();
}

Vec2 read_origin(const NodeTree& tree, const Node& node) {
  const ArgumentValue origin = find_argument(tree, node, "origin");
  if (!origin.is_list() || origin.elements().size() < 2) return Vec2(0.0);
  const ValueList elements = origin.elements();
  if (!elements[0].is_number() || !elements[1].is_number()) return Vec2(0.0);
  return {elements[0].number(), elements[1].number()};
}

}  // namespace

std::optional<DrawingFormat> drawing_format_of(std::string_view name) {
  constexpr size_t kSuffix = 4;
  if (name.size() < kSuffix) return std::nullopt;
  const std::string suffix = lower_case(std::string(name.substr(name.size() - kSuffix)));
  if (suffix == ".dxf") return DrawingFormat::kDxf;
  if (suffix == ".svg") return DrawingFormat::kSvg;
  return std::nullopt;
}

bool names_drawing(const NodeTree& tree, const Node& node) {
  if (is_extrusion(node.kind)) return !file_of(tree, node).empty();
  return node.kind == NodeKind::kImport && drawing_format_of(file_of(tree, node)).has_value();
}

bool has_place(const NodeTree& tree, const Node& node) {
  return is_primitive_node(node.kind) || (is_extrusion(node.kind) && names_drawing(tree, node));
}

DrawingArguments read_drawing_arguments(const NodeTree& tree, const Node& node,
                                        NodeProblems& problems) {
  DrawingArguments result;
  result.file = file_of(tree, node);
  if (node.kind == NodeKind::kImport) {
    result.format = drawing_format_of(result.file).value_or(DrawingFormat::kDxf);
  }
  if (result.format == DrawingFormat::kSvg) {
    result.svg.is_centered = read_center(node, find_argument(tree, node, "center"), problems);
    result.svg.dpi = first_number(tree, node, "dpi").value_or(result.svg.dpi);
    return result;
  }
  const ArgumentValue layer = find_argument(tree, node, "layer");
  if (layer.is_string()) result.dxf.layer = layer.text();
  result.dxf.origin = read_origin(tree, node);
  result.dxf.scale = first_number(tree, node, "scale").value_or(result.dxf.scale);
  result.dxf.facets = read_facet_settings(tree, node);
  return result;
}

}  // namespace frontend
