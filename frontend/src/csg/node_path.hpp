// The way from the top of an evaluated design to one of its nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "language/node_tree.hpp"

namespace frontend {

/// Returns the indices, in `tree`, of the nodes from one at the design's top to that with the index
/// `node` in tree_of(tree)'s `nodes`, which is the last; empty if there is none. Of a tree with a
/// root modifier (!), of which tree_of() takes a part, the nodes around that part are among them.
std::vector<uint32_t> path_to(const language::NodeTree& tree, uint32_t node);

}  // namespace frontend
