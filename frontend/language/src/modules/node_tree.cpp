#include "language/node_tree.hpp"

#include <algorithm>
#include <utility>

#include "values/operators.hpp"

namespace language {

uint32_t NodeTree::open(NodeKind kind, uint8_t modifiers, Place place) {
  nodes.push_back({place, static_cast<uint32_t>(arguments.size()), 0, kind, modifiers});
  return size() - 1;
}

void NodeTree::remove(uint32_t node) {
  const uint32_t first = nodes[node].first_argument;
  const auto with_numbers =
      std::find_if(arguments.begin() + first, arguments.end(),
                   [](const NodeArgument& argument) { return argument.number_count > 0; });
  if (with_numbers != arguments.end()) numbers.truncate(with_numbers->first_number);
  arguments.truncate(first);
  nodes.truncate(node);
}

void NodeTree::add(ArgumentName name, Value value, ArgumentStyle style) {
  arguments.push_back({name, style, 0, 0, std::move(value)});
}

void NodeTree::add(ArgumentName name, std::span<const double> values, ArgumentStyle style) {
  arguments.push_back(
      {name, style, static_cast<uint16_t>(values.size()), static_cast<uint32_t>(numbers.size())});
  numbers.append(values);
}

namespace {

bool is_same(const Node& a, const Node& b) {
  return a.kind == b.kind && a.place == b.place && a.first_argument == b.first_argument &&
         a.end == b.end && a.modifiers == b.modifiers;
}

bool is_same(const NodeArgument& a, const NodeArgument& b) {
  return a.name == b.name && a.style == b.style && a.number_count == b.number_count &&
         a.value.type() == b.value.type() && equal(a.value, b.value);
}

}  // namespace

bool are_same(const NodeTree& a, const NodeTree& b) {
  const auto is_equal = [](const auto& x, const auto& y) { return is_same(x, y); };
  return std::equal(a.numbers.begin(), a.numbers.end(), b.numbers.begin(), b.numbers.end()) &&
         std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), is_equal) &&
         std::equal(a.arguments.begin(), a.arguments.end(), b.arguments.begin(), b.arguments.end(),
                    is_equal);
}

RootModifiers root_modifiers(const NodeTree& tree) {
  RootModifiers found;
  for (uint32_t i = 0; i < tree.size(); ++i) {
    const Node& node = tree.nodes[i];
    if ((node.modifiers & kRootModifier) == 0) continue;
    if (!found.shown) {
      found.shown = i;
    } else if (node.place != tree.nodes[*found.shown].place) {
      found.other = node.place;
      break;
    }
  }
  return found;
}

}  // namespace language
