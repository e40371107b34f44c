#include "frontend/leaf_place.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include "csg/evaluated_tree.hpp"
#include "csg/node_label.hpp"
#include "csg/node_path.hpp"
#include "csg/node_sink.hpp"
#include "language/evaluation.hpp"

namespace frontend {
namespace {

using language::Node;

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

class TrailBuilder {
 public:
  explicit TrailBuilder(const language::SourceFiles& files) : files_(files) {}

  /// `path` leads to the leaf, and may lead on to what is in it.
  LeafPlace place(const std::vector<const Node*>& path, const Node* leaf) const {
    LeafPlace result;
    for (auto node = path.rbegin(); node != path.rend(); ++node) {
      if (*node == leaf) result.leaf = result.trail.size();
      if (*node == leaf || (*node)->children.empty()) {
        const SyntaxTree tree = tree_without_children(**node, files_);
        result.trail.push_back({label_of(tree, tree.nodes.front()), place_of(**node)});
      } else if ((*node)->is_module_call) {
        const std::string_view text = files_[(*node)->place.file].text;
        result.trail.push_back({call_text(text.substr((*node)->place.offset)), place_of(**node)});
      }
    }
    return result;
  }

 private:
  SourcePlace place_of(const Node& node) const {
    const language::SourceFile& file = files_[node.place.file];
    return source_place(file.path, files_.line(node.place), file.text, node.place.offset);
  }

  const language::SourceFiles& files_;
};

/// Returns the only child that may make anything; null if there is none or there are several.
const Node* only_child(const Node& node) {
  const Node* only = nullptr;
  for (const std::shared_ptr<Node>& child : node.children) {
    if (child->children.empty() && child->name == "group") continue;
    if (only != nullptr) return nullptr;
    only = child.get();
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
  std::vector<const Node*> path = path_to(*texts.evaluation->root, place.node);
  const Node* const leaf = path.back();
  while (const Node* const child = only_child(*path.back())) path.push_back(child);
  return TrailBuilder(*texts.evaluation->files).place(path, leaf);
}

}  // namespace frontend
