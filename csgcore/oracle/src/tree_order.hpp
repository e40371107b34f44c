// Visits a tree's tokens from the outside in.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "csgcore/csg_tree.hpp"

namespace oracle {

/// Returns, for each token, the first token of the subtree that ends with it.
inline std::vector<size_t> first_tokens(std::span<const csgcore::CsgToken> tokens) {
  std::vector<size_t> firsts, open;
  for (size_t i = 0; i < tokens.size(); ++i) {
    size_t first = i;
    if (!tokens[i].is_primitive) {
      first = open[open.size() - tokens[i].value];
      open.resize(open.size() - tokens[i].value);
    }
    open.push_back(first);
    firsts.push_back(first);
  }
  return firsts;
}

/// Calls open(op), primitive(index) and close() in the order in which a CsgTreeBuilder builds the
/// tree.
template <class Visitor>
void visit_outside_in(std::span<const csgcore::CsgToken> tokens, Visitor& visitor) {
  const std::vector<size_t> firsts = first_tokens(tokens);
  std::vector<std::vector<csgcore::Op>> opened(tokens.size());  // by token, outermost first
  for (size_t i = tokens.size(); i-- > 0;) {
    if (!tokens[i].is_primitive) opened[firsts[i]].push_back(tokens[i].op);
  }
  for (size_t i = 0; i < tokens.size(); ++i) {
    for (const csgcore::Op op : opened[i]) visitor.open(op);
    if (tokens[i].is_primitive) {
      visitor.primitive(tokens[i].value);
    } else {
      visitor.close();
    }
  }
}

}  // namespace oracle
