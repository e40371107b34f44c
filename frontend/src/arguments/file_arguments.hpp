// Nodes that name files: import() and surface(), and the extrusions of older designs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "arguments/node_reader.hpp"
#include "drawings/drawing.hpp"
#include "language/language_version.hpp"

namespace frontend {

/// What a node says of the file of its solid. The file's name is as it stands in the design, empty
/// if it is missing.
struct FileArguments {
  std::string file{};
  bool is_surface = false;  // else of an import
  /// The import is by 2026's rules, which the node may tell: 2026 writes `center` of every file,
  /// 2021.01 of drawings alone.
  bool is_of_2026 = false;
  bool is_centered = false, is_inverted = false;
};
FileArguments read_import(NodeReader& reader, language::LanguageVersion language);
FileArguments read_surface(NodeReader& reader);

/// Returns whether the node's figure is a drawing: that of an import by its file's suffix, and that
/// of an extrusion where it names a file.
bool names_drawing(const NodeTree& tree, const Node& node);

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
DrawingArguments read_drawing(NodeReader& reader, language::LanguageVersion language);

}  // namespace frontend
