#include "lower/inner_parts.hpp"

namespace frontend {
namespace {

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

}  // namespace

std::vector<InnerPart> inner_parts(const PlaneSubtree& subtree) {
  std::vector<InnerPart> result;
  std::vector<uint32_t> matrices;  // that are open
  for (uint32_t i = subtree.root(); i < subtree.end();) {
    while (!matrices.empty() && i >= subtree.end_of(matrices.back())) matrices.pop_back();
    const SyntaxNode& node = subtree.syntax(i);
    const bool is_inner = i != subtree.root();
    if (!subtree.is_taken(i) || (is_inner && (node.modifiers & kDisable) != 0)) {
      i = subtree.end_of(i);
      continue;
    }
    if (is_inner && (node.modifiers & (kBackground | kHighlight)) != 0) {
      result.push_back({i, matrices});
    }
    if (!shows_parts(node.kind)) {
      i = subtree.end_of(i);
      continue;
    }
    if (node.kind == NodeKind::kMultmatrix) matrices.push_back(i);
    ++i;
  }
  return result;
}

}  // namespace frontend
