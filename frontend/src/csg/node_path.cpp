#include "csg/node_path.hpp"

namespace frontend {
namespace {

using language::Node;

/// Returns the nodes from `top` to the first one in preorder for which `is_wanted` holds; empty if
/// it holds for none.
template <typename IsWanted>
std::vector<const Node*> path_from(const Node& top, const IsWanted& is_wanted) {
  std::vector<const Node*> path;
  std::vector<size_t> next_child;
  const auto enter = [&](const Node& node) {
    path.push_back(&node);
    next_child.push_back(0);
    return is_wanted(node);
  };
  if (enter(top)) return path;
  while (!path.empty()) {
    const Node& innermost = *path.back();
    if (next_child.back() < innermost.children.size()) {
      if (enter(*innermost.children[next_child.back()++])) return path;
    } else {
      path.pop_back();
      next_child.pop_back();
    }
  }
  return path;
}

}  // namespace

std::vector<const Node*> path_to(const Node& root, uint32_t node) {
  const Node* const shown = language::root_modifiers(root).shown;
  // The root itself is no node of the tree.
  int64_t left = shown != nullptr ? int64_t{node} : int64_t{node} + 1;
  const auto is_it = [&left](const Node&) { return left-- == 0; };
  std::vector<const Node*> path = path_from(shown != nullptr ? *shown : root, is_it);
  if (path.empty()) return path;
  if (shown != nullptr) {
    std::vector<const Node*> around =
        path_from(root, [shown](const Node& other) { return &other == shown; });
    around.insert(around.end(), path.begin() + 1, path.end());
    path = std::move(around);
  }
  path.erase(path.begin());
  return path;
}

}  // namespace frontend
