#include "frontend/source_place.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "nodes/node_label.hpp"

namespace frontend {
namespace {

/// Returns the column of a byte of the text, in characters.
uint32_t column_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const std::string_view line = before.substr(before.rfind('\n') + 1);  // npos + 1 = 0
  const auto others = std::count_if(line.begin(), line.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;  // it continues a character
  });
  return static_cast<uint32_t>(line.size() - static_cast<std::size_t>(others)) + 1;
}

/// The most bytes of a call that are shown.
constexpr std::size_t kLongestCall = 40;

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Returns the call at the start of the text, up to its closing parenthesis or the line's end.
std::string call_text(std::string_view text) {
  std::size_t end = 0, depth = 0;
  char quote = 0;
  for (; end < text.size() && text[end] != '\n' && text[end] != '\r'; ++end) {
    const char c = text[end];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"') {
      quote = c;
    } else if (c == '(') {
      ++depth;
    } else if (c == ')' && --depth == 0) {
      ++end;
      break;
    }
    if (end == kLongestCall) break;
  }
  const bool is_whole = end > 0 && text[end - 1] == ')' && depth == 0;
  while (end > 0 && end < text.size() && continues_character(text[end])) --end;
  return std::string(text.substr(0, end)) + (is_whole ? "" : "…");
}

bool has_children(const NodeTree& tree, uint32_t node) { return tree.nodes[node].end > node + 1; }

/// Returns the indices of the nodes from one at the design's top to `node`, which is the last.
std::vector<uint32_t> path_to(const NodeTree& tree, uint32_t node) {
  std::vector<uint32_t> path;
  for (uint32_t i = 0; i <= node;) {
    const uint32_t end = tree.nodes[i].end;
    const bool is_around = end > node;
    if (is_around) path.push_back(i);
    i = is_around ? i + 1 : end;
  }
  return path;
}

/// Returns the only child that may make anything; nothing if there is none or there are several.
std::optional<uint32_t> only_child(const NodeTree& tree, uint32_t node) {
  std::optional<uint32_t> only;
  for (uint32_t child = node + 1; child < tree.nodes[node].end; child = tree.nodes[child].end) {
    if (!has_children(tree, child) && tree.nodes[child].kind == NodeKind::kGroup) continue;
    if (only) return std::nullopt;
    only = child;
  }
  return only;
}

}  // namespace

SourcePlace source_place(const std::string& path, uint32_t line, std::string_view text,
                         std::size_t offset) {
  const bool is_file = path.starts_with('/');
  std::string name = is_file ? std::filesystem::path(path).filename().string() : path;
  if (name.empty()) name = ".csg";
  return {is_file ? path : "", std::move(name), line, column_of(text, offset)};
}

SourcePlace source_place(const language::SourceFiles& files, language::Place place) {
  const language::SourceFile& file = files[place.file];
  return source_place(file.canonical_path(), files.line(place), file.text, place.offset);
}

std::string text_of(const SourcePlace& place) {
  if (place.line == 0) return {};
  return place.file + ':' + std::to_string(place.line) + ':' + std::to_string(place.column);
}

LeafPlace leaf_place(const DesignTree& design, uint32_t leaf) {
  const NodeTree& tree = *design.nodes;
  const language::SourceFiles& files = *design.files;
  std::vector<uint32_t> path = path_to(tree, leaf);
  while (const std::optional<uint32_t> child = only_child(tree, path.back()))
    path.push_back(*child);
  LeafPlace result;
  for (auto step = path.rbegin(); step != path.rend(); ++step) {
    const Node& node = tree.nodes[*step];
    if (*step == leaf) result.leaf = result.trail.size();
    if (*step == leaf || !has_children(tree, *step)) {
      result.trail.push_back({label_of(tree, node), source_place(files, node.place), node.place});
    } else if (node.is_module_call) {
      const std::string_view text = files[node.place.file].text;
      result.trail.push_back(
          {call_text(text.substr(node.place.offset)), source_place(files, node.place), node.place});
    }
  }
  return result;
}

}  // namespace frontend
