#include "cells/chunk.hpp"

#include <utility>

namespace csgcore {

Chunk::Root Chunk::end() const {
  return {static_cast<uint32_t>(nodes.size()), static_cast<uint32_t>(leaves.size()), tests.size()};
}

uint64_t bytes_of(const Chunk& chunk) {
  return chunk.nodes.size() * sizeof(KdNode) + chunk.leaves.size() * sizeof(Leaf) +
         chunk.tests.size() * sizeof(BlistTest);
}

namespace {

/// The size of the assembled tree.
struct Size {
  size_t nodes = 0, leaves = 0, tests = 0;
};

/// Adds the size of a chunk. The recursion is as deep as there were rounds.
void add_size(const Chunk& chunk, Size& size) {
  size.nodes += chunk.nodes.size();
  size.leaves += chunk.leaves.size();
  size.tests += chunk.tests.size();
  if (chunk.resumed.empty()) return;
  size.nodes -= chunk.paused_nodes.size();
  size.leaves -= chunk.paused_nodes.size();
  for (const uint32_t node : chunk.paused_nodes) {
    size.tests -= chunk.leaves[chunk.nodes[node].below].test_count;
  }
  for (const Chunk& resumed : chunk.resumed) add_size(resumed, size);
}

/// Adds the size of a part. The recursion is as deep as parts are nested.
void add_size(const Part& part, Size& size) {
  if (part.split.axis == KdNode::kLeafAxis) {
    add_size(part.chunk, size);
    return;
  }
  ++size.nodes;
  add_size(*part.below, size);
  add_size(*part.above, size);
}

uint32_t new_slot(Chunk& tree) {
  tree.nodes.emplace_back();
  return static_cast<uint32_t>(tree.nodes.size() - 1);
}

/// Appends the leaves [first, end) and their tests to the tree.
void append_leaves(const Chunk& chunk, uint32_t first, uint32_t end, Chunk& tree) {
  if (first == end) return;
  const auto test_of = [&](uint32_t leaf) {
    return leaf < chunk.leaves.size() ? chunk.leaves[leaf].first_test : chunk.tests.size();
  };
  const uint64_t first_test = test_of(first);
  const uint64_t grown = tree.tests.size() - first_test;  // modulo 2^64, since it may be negative
  const size_t size = tree.leaves.size();
  tree.leaves.insert(tree.leaves.end(), chunk.leaves.begin() + first, chunk.leaves.begin() + end);
  for (size_t i = size; i < tree.leaves.size(); ++i) tree.leaves[i].first_test += grown;
  tree.tests.insert(tree.tests.end(), chunk.tests.begin() + static_cast<std::ptrdiff_t>(first_test),
                    chunk.tests.begin() + static_cast<std::ptrdiff_t>(test_of(end)));
}

/// Writes the subtrees of a chunk in order, with those that were resumed in it, and frees resumed
/// chunks as it goes.
class ChunkWriter {
 public:
  ChunkWriter(Chunk& chunk, Chunk& tree) : chunk_(chunk), tree_(tree) {}

  bool is_done() const { return root_ == chunk_.roots.size(); }

  /// Writes the next subtree: its root to `slot`, its other nodes to the end. The recursion is as
  /// deep as there were rounds.
  void write_next(uint32_t slot) {
    const Chunk::Root first = chunk_.roots[root_], end = chunk_.end_of(root_);
    ++root_;
    if (chunk_.resumed.empty()) {
      write_whole(first, end, slot);
    } else {
      write_with_resumed(first, end, slot);
    }
  }

 private:
  void write_whole(const Chunk::Root& first, const Chunk::Root& end, uint32_t slot) {
    // Indices grow by these numbers, modulo 2^32, since they may be negative.
    const size_t size = tree_.nodes.size();
    const uint32_t nodes = static_cast<uint32_t>(size) - 1 - first.node;
    const uint32_t leaves = static_cast<uint32_t>(tree_.leaves.size()) - first.leaf;
    const auto move_indices = [&](KdNode& node) {
      const bool is_leaf = node.axis == KdNode::kLeafAxis;
      node.below += is_leaf ? leaves : nodes;
      node.above += is_leaf ? 0 : nodes;
    };
    tree_.nodes[slot] = chunk_.nodes[first.node];
    tree_.nodes.insert(tree_.nodes.end(), chunk_.nodes.begin() + first.node + 1,
                       chunk_.nodes.begin() + end.node);
    move_indices(tree_.nodes[slot]);
    for (size_t i = size; i < tree_.nodes.size(); ++i) move_indices(tree_.nodes[i]);
    append_leaves(chunk_, first.leaf, end.leaf, tree_);
  }

  void write_with_resumed(const Chunk::Root& first, const Chunk::Root& end, uint32_t slot) {
    std::vector<uint32_t> places(end.node - first.node);  // by node, its index in the tree
    // Leaves are copied in runs, up to the next paused one.
    uint32_t first_leaf = first.leaf, leaf = first.leaf;
    for (uint32_t i = first.node; i < end.node; ++i) {
      const uint32_t place = i == first.node ? slot : new_slot(tree_);
      places[i - first.node] = place;
      if (paused_ < chunk_.paused_nodes.size() && chunk_.paused_nodes[paused_] == i) {
        ++paused_;
        append_leaves(chunk_, first_leaf, leaf, tree_);
        first_leaf = ++leaf;
        write_resumed(place);
        continue;
      }
      KdNode node = chunk_.nodes[i];
      if (node.axis == KdNode::kLeafAxis) {
        node.below = static_cast<uint32_t>(tree_.leaves.size()) + leaf - first_leaf;
        ++leaf;
      }
      tree_.nodes[place] = node;
    }
    append_leaves(chunk_, first_leaf, leaf, tree_);
    for (uint32_t i = first.node; i < end.node; ++i) {
      const KdNode& node = chunk_.nodes[i];
      if (node.axis == KdNode::kLeafAxis) continue;
      tree_.nodes[places[i - first.node]].below = places[node.below - first.node];
      tree_.nodes[places[i - first.node]].above = places[node.above - first.node];
    }
  }

  void write_resumed(uint32_t slot) {
    if (!resumed_) resumed_ = std::make_unique<ChunkWriter>(chunk_.resumed[next_resumed_++], tree_);
    resumed_->write_next(slot);
    if (!resumed_->is_done()) return;
    resumed_->chunk_ = {};
    resumed_.reset();
  }

  Chunk& chunk_;
  Chunk& tree_;
  size_t root_ = 0, paused_ = 0, next_resumed_ = 0;
  std::unique_ptr<ChunkWriter> resumed_;  // the writer of the resumed chunk that is being written
};

/// Writes a part, and frees its memory as it goes. The recursion is as deep as parts are nested.
void place(Part& part, uint32_t slot, Chunk& tree) {
  if (part.split.axis == KdNode::kLeafAxis) {
    ChunkWriter(part.chunk, tree).write_next(slot);
    part.chunk = {};
    return;
  }
  tree.nodes[slot] = {part.split.position, part.split.axis, 0, 0};
  const uint32_t below = tree.nodes[slot].below = new_slot(tree);
  place(*part.below, below, tree);
  const uint32_t above = tree.nodes[slot].above = new_slot(tree);
  place(*part.above, above, tree);
}

}  // namespace

Chunk assemble(std::unique_ptr<Part> part) {
  if (part->split.axis == KdNode::kLeafAxis && part->chunk.resumed.empty()) {
    return std::move(part->chunk);
  }
  Size size;
  add_size(*part, size);
  Chunk tree;
  tree.nodes.reserve(size.nodes);
  tree.leaves.reserve(size.leaves);
  tree.tests.reserve(size.tests);
  place(*part, new_slot(tree), tree);
  return tree;
}

void place(Chunk chunk, std::span<const uint32_t> slots, Chunk& tree) {
  ChunkWriter writer(chunk, tree);
  for (const uint32_t slot : slots) writer.write_next(slot);
}

}  // namespace csgcore
