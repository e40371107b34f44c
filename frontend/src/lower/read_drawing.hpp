// Nodes that read a drawing: import() of a DXF or SVG, and the extrusions of older designs.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "drawings/drawing.hpp"
#include "frontend/design_tree.hpp"
#include "lower/node_problems.hpp"

namespace frontend {

/// Returns whether the node's figure is a drawing: that of an import by its file's suffix, and that
/// of an extrusion where it names a file.
bool names_drawing(const NodeTree& tree, const Node& node);

/// Returns whether the node has a place among Primitive::id.
bool has_place(const NodeTree& tree, const Node& node);

enum class DrawingFormat : uint8_t { kDxf, kSvg };

/// Returns the format that a file's name tells; nothing: it is no drawing's.
std::optional<DrawingFormat> drawing_format_of(std::string_view name);

/// What a node says of its drawing; is_faceted is left to its reader.
struct DrawingArguments {
  std::string file;  // as it stands in the design
  DrawingFormat format = DrawingFormat::kDxf;
  DxfSettings dxf{};
  SvgSettings svg{};
};

/// The node names a drawing. Extrusions read DXF alone, as in OpenSCAD.
DrawingArguments read_drawing_arguments(const NodeTree& tree, const Node& node,
                                        NodeProblems& problems);

}  // namespace frontend
