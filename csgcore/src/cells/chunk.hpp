// Pieces of a kd-tree while it is built.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "cells/split.hpp"
#include "csgcore/kd_tree.hpp"

namespace csgcore {

struct Cell {
  Box box;
  uint32_t depth = 0;
  uint32_t stalled = 0;  // divisions since a primitive last left
  uint32_t doubled = 0;  // divisions in a row of which both halves kept every primitive, but for
                         // those that only cut off empty space
  /// How many tests the leaves below may hold for each of the cell's own. Each division hands
  /// its cell's share on to the halves, in proportion to what they hold.
  double allowance = 0;
  /// What the subtree may cost in this round (cell_budget.hpp).
  uint64_t credit = 0;
};

/// A cell whose credit did not suffice. Until it is resumed, or given up, it is a leaf of kind
/// kReplaced.
struct Paused {
  Cell cell;
  uint64_t needed = 0;  // the credit that takes it one step further
};

/// What one task produces: subtrees, one behind the other, each of them in preorder: a node, all
/// that lies below its plane, all that lies above. Indices are local to the chunk. Leaves and
/// tests stand in the nodes' order.
struct Chunk {
  /// Where a subtree begins.
  struct Root {
    uint32_t node = 0;
    uint32_t leaf = 0;
    uint64_t test = 0;
  };
  std::vector<KdNode> nodes;
  std::vector<Leaf> leaves;
  std::vector<BlistTest> tests;
  std::vector<Root> roots;
  std::vector<uint32_t> paused_nodes;  // in order
  std::vector<Paused> paused;          // at these nodes; none after they were resumed
  /// Together they have a subtree for each of `paused_nodes`, in order, if those were resumed.
  std::vector<Chunk> resumed;
  int64_t cost = 0;  // without that of `resumed`
  /// What it may cost. None but the first round's have a limit.
  int64_t limit = std::numeric_limits<int64_t>::max() / 2;

  Root end() const;
  /// Where the subtree of a root ends.
  Root end_of(size_t root) const { return root + 1 < roots.size() ? roots[root + 1] : end(); }
  uint64_t credit() const { return static_cast<uint64_t>(std::max(limit - cost, int64_t{0})); }
  void begin_root() { roots.push_back(end()); }
  /// Of the i-th of `paused`.
  Leaf& paused_leaf(size_t i) { return leaves[nodes[paused_nodes[i]].below]; }
  const Leaf& paused_leaf(size_t i) const { return leaves[nodes[paused_nodes[i]].below]; }
};

/// Of nodes, leaves and tests.
uint64_t bytes_of(const Chunk& chunk);

/// Either a chunk of one subtree, or a division whose two sides are parts of their own.
struct Part {
  Split split{KdNode::kLeafAxis, 0};
  std::unique_ptr<Part> below, above;
  Chunk chunk;
};

}  // namespace csgcore
