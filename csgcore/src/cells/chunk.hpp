// Pieces of a kd-tree while it is built, and their assembly.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "cells/split.hpp"
#include "csgcore/kd_tree.hpp"

namespace csgcore {

struct Cell {
  Box box;
  uint32_t depth = 0;
  uint32_t stalled = 0;  // divisions since the list last became shorter
  uint32_t doubled = 0;  // divisions in a row in which both halves kept every test, without
                         // counting those that cut off empty space
  /// How many tests the leaves below may hold for each test of the cell. A division divides this
  /// share among the halves, in proportion to their tests.
  double allowance = 0;
  /// How much the subtree may cost in this round, in bytes (cell_budget.hpp).
  uint64_t credit = 0;
};

/// A cell whose credit did not suffice. It is a leaf of kind kReplaced until it is resumed or given
/// up.
struct Paused {
  Cell cell;
  uint64_t needed = 0;  // the credit that takes it one step further
};

/// The product of one task: subtrees one after the other, each in preorder (a node, all nodes below
/// its plane, all nodes above it). Indices are local to the chunk. Leaves and tests are in the
/// order of the nodes.
struct Chunk {
  /// The place where a subtree begins.
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
  std::vector<Paused> paused;          // the cells at these nodes; empty once they were resumed
  /// If the paused cells were resumed, these chunks together have a subtree for each of
  /// paused_nodes, in order.
  std::vector<Chunk> resumed;
  int64_t cost = 0;  // in bytes, without that of `resumed`
  /// How much the chunk may cost. Only chunks of the first round have a limit.
  int64_t limit = std::numeric_limits<int64_t>::max() / 2;

  Root end() const;
  /// Returns the place where the subtree of a root ends.
  Root end_of(size_t root) const { return root + 1 < roots.size() ? roots[root + 1] : end(); }
  uint64_t credit() const { return static_cast<uint64_t>(std::max(limit - cost, int64_t{0})); }
  void begin_root() { roots.push_back(end()); }
  /// The leaf of paused[i].
  Leaf& paused_leaf(size_t i) { return leaves[nodes[paused_nodes[i]].below]; }
  const Leaf& paused_leaf(size_t i) const { return leaves[nodes[paused_nodes[i]].below]; }
};

/// The bytes of the chunk's nodes, leaves and tests.
uint64_t bytes_of(const Chunk& chunk);

/// A subtree: either a chunk (split.axis is kLeafAxis), or a division whose sides are two parts.
struct Part {
  Split split{KdNode::kLeafAxis, 0};
  std::unique_ptr<Part> below, above;
  Chunk chunk;
};

/// Returns the whole tree as one chunk, which is the chunk that a single task would have produced
/// if no cell had been paused.
Chunk assemble(std::unique_ptr<Part> part);

/// Puts the subtrees of `chunk`, in order, into `tree`: each root replaces the node at its slot,
/// and other nodes are appended. Resumed subtrees take the places of the paused cells.
void place(Chunk chunk, std::span<const uint32_t> slots, Chunk& tree);

}  // namespace csgcore
