#include "frontend/leaf_place.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "csg/evaluated_tree.hpp"
#include "csg/node_label.hpp"
#include "csg/node_path.hpp"
#include "csg/node_sink.hpp"
#include "language/evaluation.hpp"

namespace frontend {
namespace {

using language::NodeTree;

/// The most bytes of a call that are shown.
constexpr std::size_t kLongestCall = 40;

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Returns the column of a byte of the text, in characters.
uint32_t column_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const std::string_view line = before.substr(before.rfind('\n') + 1);  // npos + 1 = 0
  const auto others = std::count_if(line.begin(), line.end(), continues_character);
  return static_cast<uint32_t>(line.size() - static_cast<std::size_t>(others)) + 1;
}

/// Returns the place of a byte in a file.
SourcePlace source_place(const std::string& path, uint32_t line, std::string_view text,
                         std::size_t offset) {
  const bool is_file = path.starts_with('/');
  std::string name = is_file ? std::filesystem::path(path).filename().string() : path;
  if (name.empty()) name = ".csg";
  return {is_file ? path : "", std::move(name), line, column_of(text, offset)};
}

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

class TrailBuilder {
 public:
  TrailBuilder(const NodeTree& tree, const language::SourceFiles& files)
      : tree_(tree), files_(files) {}

  /// `path` leads to the leaf, and may lead on to what is in it.
  LeafPlace place(const std::vector<uint32_t>& path, uint32_t leaf) const {
    LeafPlace result;
    for (auto step = path.rbegin(); step != path.rend(); ++step) {
      const language::Node& node = tree_.nodes[*step];
      if (*step == leaf) result.leaf = result.trail.size();
      if (*step == leaf || !has_children(tree_, *step)) {
        const SyntaxTree alone = tree_without_children(tree_, *step, files_);
        result.trail.push_back({label_of(alone, alone.nodes.front()), place_of(node)});
      } else if (node.is_module_call) {
        const std::string_view text = files_[node.place.file].text;
        result.trail.push_back({call_text(text.substr(node.place.offset)), place_of(node)});
      }
    }
    return result;
  }

 private:
  SourcePlace place_of(const language::Node& node) const {
    const language::SourceFile& file = files_[node.place.file];
    return source_place(file.canonical_path(), files_.line(node.place), file.text,
                        node.place.offset);
  }

  const NodeTree& tree_;
  const language::SourceFiles& files_;
};

/// Returns the only child that may make anything; nothing if there is none or there are several.
std::optional<uint32_t> only_child(const NodeTree& tree, uint32_t node) {
  std::optional<uint32_t> only;
  for (uint32_t child = node + 1; child < tree.nodes[node].end; child = tree.nodes[child].end) {
    if (!has_children(tree, child) && tree.nodes[child].name == "group") continue;
    if (only) return std::nullopt;
    only = child;
  }
  return only;
}

}  // namespace

std::string text_of(const SourcePlace& place) {
  if (place.line == 0) return {};
  return place.file + ':' + std::to_string(place.line) + ':' + std::to_string(place.column);
}

LeafPlace leaf_place(const DesignTexts& texts, const PrimitivePlace& place) {
  if (!texts.evaluation) {
    const SyntaxTree tree = parse_subtree(texts.csg->view(), place.offset);
    return {{{label_of(tree, tree.nodes.front()),
              source_place(texts.csg_path, place.line, texts.csg->view(), place.offset)}},
            0};
  }
  const NodeTree& tree = *texts.evaluation->tree;
  std::vector<uint32_t> path = path_to(tree, place.node);
  const uint32_t leaf = path.back();
  while (const std::optional<uint32_t> child = only_child(tree, path.back()))
    path.push_back(*child);
  return TrailBuilder(tree, *texts.evaluation->files).place(path, leaf);
}

}  // namespace frontend
