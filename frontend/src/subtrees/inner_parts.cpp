#include "subtrees/inner_parts.hpp"

namespace frontend {
namespace {

constexpr uint8_t kBackground = language::kBackgroundModifier;
constexpr uint8_t kHighlight = language::kHighlightModifier;

/// A node that is open, the modifiers that it hands down, and the parts around what it consists of.
struct OpenPart {
  uint32_t end;
  uint8_t modifiers;
  size_t parts;
};

}  // namespace

std::vector<InnerPart> inner_parts(const Subtree& subtree) {
  std::vector<InnerPart> result;
  std::vector<uint32_t> around;  // that are open
  std::vector<OpenPart> open;
  for (uint32_t i = subtree.root(); i < subtree.end();) {
    while (!around.empty() && i >= subtree.end_of(around.back())) around.pop_back();
    while (!open.empty() && i >= open.back().end) open.pop_back();
    const Node& node = subtree.syntax(i);
    const bool is_inner = i != subtree.root();
    uint8_t modifiers = is_inner ? node.modifiers & (kBackground | kHighlight) : 0;
    // What is in the background is not overlaid with what is around it.
    if ((modifiers & kBackground) == 0 && !open.empty()) modifiers |= open.back().modifiers;
    const InnerParts parts_of_node = subtree.row(i).inner_parts;
    const bool is_leaf = parts_of_node != InnerParts::kOfMembers;
    const size_t parts = open.empty() ? 0 : open.back().parts;
    const bool is_part = is_leaf && modifiers != 0 && parts < kMostNestedHighlights;
    if (is_part) result.push_back({i, modifiers, around});
    if (parts_of_node == InnerParts::kNone) {
      i = subtree.end_of(i);
      continue;
    }
    open.push_back(
        {subtree.end_of(i), is_leaf ? uint8_t{0} : modifiers, parts + (is_part ? 1 : 0)});
    if (node.kind == NodeKind::kMultmatrix || node.kind == NodeKind::kColor) around.push_back(i);
    ++i;
  }
  return result;
}

}  // namespace frontend
