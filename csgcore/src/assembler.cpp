#include "assembler.hpp"

namespace csgcore {

void Assembler::place(const Part& part, uint32_t slot) {
  if (part.split.axis == KdNode::kLeafAxis) {
    append_chunk(part.chunk, slot);
    return;
  }
  all_.nodes[slot] = {part.split.position, part.split.axis, 0, 0};
  const uint32_t below = all_.nodes[slot].below = new_slot();
  place(*part.below, below);
  const uint32_t above = all_.nodes[slot].above = new_slot();
  place(*part.above, above);
}

uint32_t Assembler::new_slot() {
  all_.nodes.push_back({});
  return static_cast<uint32_t>(all_.nodes.size() - 1);
}

void Assembler::append_chunk(const Chunk& chunk, uint32_t slot) {
  // The chunk's node 0 goes to the slot, node 1 to the end.
  const uint32_t node_base = static_cast<uint32_t>(all_.nodes.size()) - 1;
  const uint32_t leaf_base = static_cast<uint32_t>(all_.leaves.size());
  const uint64_t literal_base = all_.literals.size();
  all_.nodes.resize(all_.nodes.size() + chunk.nodes.size() - 1);
  for (size_t i = 0; i < chunk.nodes.size(); ++i) {
    KdNode node = chunk.nodes[i];
    const bool is_leaf = node.axis == KdNode::kLeafAxis;
    node.below += is_leaf ? leaf_base : node_base;
    node.above += is_leaf ? 0 : node_base;
    all_.nodes[i == 0 ? slot : node_base + i] = node;
  }
  for (Leaf leaf : chunk.leaves) {
    leaf.first_literal += literal_base;
    all_.leaves.push_back(leaf);
  }
  all_.literals.insert(all_.literals.end(), chunk.literals.begin(), chunk.literals.end());
}

}  // namespace csgcore
