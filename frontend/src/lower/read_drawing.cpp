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
std::string_view file_of(const SyntaxTree& tree, const SyntaxNode& node) {
  const size_t position = is_extrusion(node.kind) ? kByNameOnly : 0;
  const Value* file = find_argument(tree, node, "file", position);
  return file != nullptr && file->kind == ValueKind::kString ? tree.text_of(*file) : "";
}

/// The number, or the first of a list: an extrusion's `scale` scales its drawing, too.
std::optional<double> first_number(const SyntaxTree& tree, const SyntaxNode& node,
                                   std::string_view name) {
  const Value* value = find_argument(tree, node, name, kByNameOnly);
  if (value == nullptr) return std::nullopt;
  if (value->kind == ValueKind::kList && value->count > 0) {
    value = &tree.elements_of(*value).front();
  }
  if (value->kind != ValueKind::kNumber) return std::nullopt;
  return value->number;
}

Vec2 read_origin(const SyntaxTree& tree, const SyntaxNode& node) {
  const Value* origin = find_argument(tree, node, "origin", kByNameOnly);
  if (origin == nullptr || origin->kind != ValueKind::kList || origin->count < 2) return Vec2(0.0);
  const std::span<const Value> elements = tree.elements_of(*origin);
  if (elements[0].kind != ValueKind::kNumber || elements[1].kind != ValueKind::kNumber) {
    return Vec2(0.0);
  }
  return {elements[0].number, elements[1].number};
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

bool names_drawing(const SyntaxTree& tree, const SyntaxNode& node) {
  if (is_extrusion(node.kind)) return !file_of(tree, node).empty();
  return node.kind == NodeKind::kImport && drawing_format_of(file_of(tree, node)).has_value();
}

bool has_place(const SyntaxTree& tree, const SyntaxNode& node) {
  return is_primitive_node(node.kind) || (is_extrusion(node.kind) && names_drawing(tree, node));
}

DrawingArguments read_drawing_arguments(const SyntaxTree& tree, const SyntaxNode& node,
                                        NodeProblems& problems) {
  DrawingArguments result;
  result.file = file_of(tree, node);
  if (node.kind == NodeKind::kImport) {
    result.format = drawing_format_of(result.file).value_or(DrawingFormat::kDxf);
  }
  if (result.format == DrawingFormat::kSvg) {
    const Value* center = find_argument(tree, node, "center", kByNameOnly);
    result.svg.is_centered = center != nullptr && read_center(node, *center, problems);
    result.svg.dpi = first_number(tree, node, "dpi").value_or(result.svg.dpi);
    return result;
  }
  const Value* layer = find_argument(tree, node, "layer", kByNameOnly);
  if (layer != nullptr && layer->kind == ValueKind::kString) {
    result.dxf.layer = tree.text_of(*layer);
  }
  result.dxf.origin = read_origin(tree, node);
  result.dxf.scale = first_number(tree, node, "scale").value_or(result.dxf.scale);
  result.dxf.facets = read_facet_settings(tree, node);
  return result;
}

}  // namespace frontend
