#include "language/node.hpp"

#include <iterator>
#include <unordered_set>
#include <utility>

namespace language {

Node::~Node() {
  // A tree's own destruction would recurse: each child that nothing else holds is emptied first.
  std::vector<std::shared_ptr<Node>> pending = std::move(children);
  while (!pending.empty()) {
    const std::shared_ptr<Node> node = std::move(pending.back());
    pending.pop_back();
    if (node == nullptr || node.use_count() != 1) continue;
    std::move(node->children.begin(), node->children.end(), std::back_inserter(pending));
    node->children.clear();
  }
}

RootModifiers root_modifiers(const Node& root) {
  RootModifiers found;
  std::vector<const Node*> pending = {&root};
  std::unordered_set<const Node*> shared;  // those seen that stand in several places
  while (!pending.empty()) {
    const Node& node = *pending.back();
    pending.pop_back();
    if ((node.modifiers & kRootModifier) != 0) {
      if (found.shown == nullptr) {
        found.shown = &node;
      } else if (node.place != found.shown->place) {
        found.other = node.place;
        return found;
      }
    }
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
      if (child->use_count() > 1 && !shared.insert(child->get()).second) continue;
      pending.push_back(child->get());
    }
  }
  return found;
}

}  // namespace language
