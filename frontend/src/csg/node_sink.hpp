// Receives the nodes of a file one by one while it is parsed.
#pragma once

#include <cstdint>
#include <stop_token>
#include <string_view>

#include "frontend/syntax_tree.hpp"

namespace frontend {

class NodeSink {
 public:
  virtual ~NodeSink() = default;
  /// Takes the node that was parsed last, with its arguments. Its descendants are not parsed yet,
  /// and its subtree_end is kOpenSubtree until it is closed. `offset` is that of its name, in bytes
  /// from the text's start.
  virtual void take(uint32_t node, uint32_t offset) = 0;
};

/// The subtree_end of a node that is still being parsed. It is beyond every node.
constexpr uint32_t kOpenSubtree = 0xFFFFFFFFu;

/// Parses like parse(), but drops a node's arguments from `tree` after `sink` has taken the node.
/// `tree` has a file name and nothing else before.
void parse_nodes(std::string_view text, SyntaxTree& tree, NodeSink& sink,
                 const std::stop_token& stop);

/// Returns the tree of the node alone whose name is at `offset` of a text that parse_nodes() has
/// taken, with all arguments. Its places are those in the text from there on.
SyntaxTree parse_subtree(std::string_view text, uint32_t offset);

}  // namespace frontend
