#include "arguments/file_arguments.hpp"

#include "base/lower_case.hpp"

namespace frontend {
namespace {

bool is_extrusion(NodeKind kind) {
  return kind == NodeKind::kLinearExtrude || kind == NodeKind::kRotateExtrude;
}

/// Returns the name of the node's file; empty if it is missing.
std::string_view file_of(const NodeReader& reader) {
  return reader.text("file", is_extrusion(reader.node().kind) ? NodeReader::kByNameOnly : 0);
}

FileArguments read_file(NodeReader& reader) {
  const ArgumentValue file = reader.find("file", 0);
  if (!file.is_string()) reader.tell_wrong_type("file", file, "a name");
  return {.file = std::string(file_of(reader))};
}

/// The number, or the first of a list: an extrusion's `scale` scales its drawing, too.
std::optional<double> first_number(const NodeReader& reader, language::ArgumentName name) {
  ArgumentValue value = reader.find(name);
  if (value.is_list() && !value.elements().empty()) value = value.elements()[0];
  if (!value.is_number()) return std::nullopt;
  return value.number();
}

/// Returns nothing where the text is missing, or is none.
std::optional<std::string> given_text(const NodeReader& reader, language::ArgumentName name) {
  const ArgumentValue value = reader.find(name);
  if (!value.is_string()) return std::nullopt;
  return std::string(value.text());
}

Vec2 read_origin(const NodeReader& reader) {
  const ArgumentValue origin = reader.find("origin");
  if (!origin.is_list() || origin.elements().size() < 2) return Vec2(0.0);
  const ValueList elements = origin.elements();
  if (!elements[0].is_number() || !elements[1].is_number()) return Vec2(0.0);
  return {elements[0].number(), elements[1].number()};
}

}  // namespace

FileArguments read_import(NodeReader& reader, language::LanguageVersion language) {
  FileArguments result = read_file(reader);
  result.is_of_2026 =
      language == language::LanguageVersion::k2026 || !reader.find("center").is_undef();
  result.is_centered = reader.center();
  return result;
}

FileArguments read_surface(NodeReader& reader) {
  FileArguments result = read_file(reader);
  result.is_surface = true;
  result.is_centered = reader.center(1);
  result.is_inverted = reader.is_true("invert", 2);
  return result;
}

std::optional<DrawingFormat> drawing_format_of(std::string_view name) {
  constexpr size_t kSuffixBytes = 4;
  if (name.size() < kSuffixBytes) return std::nullopt;
  const std::string suffix = lower_case(std::string(name.substr(name.size() - kSuffixBytes)));
  if (suffix == ".dxf") return DrawingFormat::kDxf;
  if (suffix == ".svg") return DrawingFormat::kSvg;
  return std::nullopt;
}

bool names_drawing(const NodeTree& tree, const Node& node) {
  if (!is_extrusion(node.kind) && node.kind != NodeKind::kImport) return false;
  NodeProblems untold;
  const std::string_view file = file_of(NodeReader(tree, node, untold));
  return is_extrusion(node.kind) ? !file.empty() : drawing_format_of(file).has_value();
}

DrawingArguments read_drawing(NodeReader& reader, language::LanguageVersion language) {
  DrawingArguments result;
  result.file = file_of(reader);
  if (reader.node().kind == NodeKind::kImport) {
    result.format = drawing_format_of(result.file).value_or(DrawingFormat::kDxf);
  }
  if (result.format == DrawingFormat::kSvg) {
    result.svg.is_centered = reader.center();
    result.svg.dpi = first_number(reader, "dpi").value_or(result.svg.dpi);
    result.svg.language = language;
    result.svg.id = given_text(reader, "id");
    result.svg.layer = given_text(reader, "layer");
    result.svg.facets = reader.facets();
    return result;
  }
  result.dxf.is_centered = reader.node().kind == NodeKind::kImport && reader.is_true("center");
  result.dxf.layer = reader.text("layer");
  result.dxf.origin = read_origin(reader);
  result.dxf.scale = first_number(reader, "scale").value_or(result.dxf.scale);
  result.dxf.facets = reader.facets();
  return result;
}

}  // namespace frontend
