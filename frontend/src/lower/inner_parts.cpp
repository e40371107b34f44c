#include "lower/inner_parts.hpp"

#include "lower/resolved_modifiers.hpp"

namespace frontend {
namespace {

constexpr uint8_t kBackground = language::kBackgroundModifier;
constexpr uint8_t kHighlight = language::kHighlightModifier;

/// Whether parts are shown that stand inside of such a node.
bool shows_parts(NodeKind kind) {
  switch (kind) {
    case NodeKind::kHull:
    case NodeKind::kMinkowski:
    case NodeKind::kResize:
    case NodeKind::kMultmatrix:
    case NodeKind::kColor:
    case NodeKind::kGroup:
    case NodeKind::kUnion:
    case NodeKind::kDifference:
    case NodeKind::kIntersection:
      return true;
    default:
      return false;
  }
}

/// Whether the node's children are leaves by themselves.
bool is_group(NodeKind kind) {
  return kind == NodeKind::kMultmatrix || kind == NodeKind::kColor || kind == NodeKind::kGroup ||
         kind == NodeKind::kUnion;
}

/// A node that is open, the modifiers that it hands down, and the parts around what it consists of.
struct Open {
  uint32_t end;
  uint8_t modifiers;
  size_t parts;
};

}  // namespace

std::vector<InnerPart> inner_parts(const PlaneSubtree& subtree) {
  std::vector<InnerPart> result;
  std::vector<uint32_t> around;  // that are open
  std::vector<Open> open;
  for (uint32_t i = subtree.root(); i < subtree.end();) {
    while (!around.empty() && i >= subtree.end_of(around.back())) around.pop_back();
    while (!open.empty() && i >= open.back().end) open.pop_back();
    const Node& node = subtree.syntax(i);
    const bool is_inner = i != subtree.root();
    uint8_t modifiers = is_inner ? node.modifiers & (kBackground | kHighlight) : 0;
    // What is in the background is not overlaid with what is around it.
    if ((modifiers & kBackground) == 0 && !open.empty()) modifiers |= open.back().modifiers;
    const bool is_leaf = !is_group(node.kind);
    const size_t parts = open.empty() ? 0 : open.back().parts;
    const bool is_part = is_leaf && modifiers != 0 && parts < kMostNestedHighlights;
    if (is_part) result.push_back({i, modifiers, around});
    if (!shows_parts(node.kind)) {
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
