// A file's nodes one by one, as they are parsed.
#pragma once

#include <cstdint>
#include <stop_token>
#include <string_view>

#include "frontend/syntax_tree.hpp"

namespace frontend {

class NodeSink {
 public:
  virtual ~NodeSink() = default;
  /// The node that was parsed last, with its arguments. Of its descendants none is known yet: until
  /// it is closed its subtree_end is kOpenSubtree. `offset`: of its name, in bytes from the text's
  /// start.
  virtual void take(uint32_t node, uint32_t offset) = 0;
};

/// The end of what is still being parsed: beyond every node.
constexpr uint32_t kOpenSubtree = 0xFFFFFFFFu;

/// parse() for who needs all nodes, but the arguments of each only once: what `tree`, which has a
/// file name and nothing else, holds of them is dropped after `sink` has taken the node.
void parse_nodes(std::string_view text, SyntaxTree& tree, NodeSink& sink,
                 const std::stop_token& stop);

}  // namespace frontend
