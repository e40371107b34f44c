#include "language/node.hpp"

#include <algorithm>
#include <iterator>
#include <unordered_set>
#include <utility>

#include "values/operators.hpp"

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

namespace {

bool are_same(const NodeArgument& a, const NodeArgument& b) {
  return a.name == b.name && a.style == b.style && a.value.type() == b.value.type() &&
         equal(a.value, b.value);
}

/// Compares all but the children themselves.
bool are_alike(const Node& a, const Node& b) {
  return a.name == b.name && a.modifiers == b.modifiers && a.place == b.place &&
         a.children.size() == b.children.size() &&
         std::equal(a.arguments.begin(), a.arguments.end(), b.arguments.begin(), b.arguments.end(),
                    [](const NodeArgument& x, const NodeArgument& y) { return are_same(x, y); });
}

}  // namespace

bool are_same(const Node& a, const Node& b) {
  std::vector<std::pair<const Node*, const Node*>> pending = {{&a, &b}};
  while (!pending.empty()) {
    const auto [x, y] = pending.back();
    pending.pop_back();
    if (x == y) continue;
    if (!are_alike(*x, *y)) return false;
    for (size_t i = 0; i < x->children.size(); ++i) {
      pending.emplace_back(x->children[i].get(), y->children[i].get());
    }
  }
  return true;
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
