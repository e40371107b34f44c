#include "frontend/leaf_place.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "csg/evaluated_tree.hpp"
#include "csg/node_label.hpp"
#include "csg/node_path.hpp"
#include "frontend/parser.hpp"
#include "language/evaluation.hpp"

namespace frontend {
namespace {

using language::NodeTree;

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
        result.trail.push_back(
            {label_of(alone, alone.nodes.front()), source_place(files_, node.place)});
      } else if (node.is_module_call) {
        const std::string_view text = files_[node.place.file].text;
        result.trail.push_back(
            {call_text(text.substr(node.place.offset)), source_place(files_, node.place)});
      }
    }
    return result;
  }

 private:
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
