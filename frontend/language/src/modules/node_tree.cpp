#include "language/node_tree.hpp"

#include <algorithm>
#include <utility>

namespace language {

uint32_t NodeTree::open(NodeKind kind, uint8_t modifiers, Place place) {
  nodes.push_back({place, static_cast<uint32_t>(arguments.size()), 0, kind, modifiers});
  return size() - 1;
}

NodeTree NodeTree::subtree(uint32_t node) const {
  NodeTree result;
  result.has_all_digits = has_all_digits;
  for (uint32_t i = node; i < nodes[node].end; ++i) {
    Node copy = nodes[i];
    copy.first_argument = static_cast<uint32_t>(result.arguments.size());
    copy.end -= node;
    for (const NodeArgument& argument : arguments_of(nodes[i])) {
      result.arguments.push_back({argument.name, argument.style, argument.number_count,
                                  static_cast<uint32_t>(result.numbers.size()), argument.value});
      result.numbers.append(numbers_of(argument));
    }
    result.nodes.push_back(copy);
  }
  return result;
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
