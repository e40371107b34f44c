#include "cells/chunk.hpp"

namespace csgcore {

Chunk::Root Chunk::end() const {
  return {static_cast<uint32_t>(nodes.size()), static_cast<uint32_t>(leaves.size()), tests.size()};
}

uint64_t bytes_of(const Chunk& chunk) {
  return chunk.nodes.size() * sizeof(KdNode) + chunk.leaves.size() * sizeof(Leaf) +
         chunk.tests.size() * sizeof(BlistTest);
}

}  // namespace csgcore
