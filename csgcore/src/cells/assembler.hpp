// Assembles the pieces of a kd-tree.
#pragma once

#include <memory>
#include <span>

#include "cells/chunk.hpp"

namespace csgcore {

/// Returns the whole tree as one chunk, which is the chunk that a single task would have produced
/// if no cell had been paused.
Chunk assemble(std::unique_ptr<Part> part);

/// Puts the subtrees of `chunk`, in order, into `tree`: each root replaces the node at its slot,
/// and other nodes are appended. Resumed subtrees take the places of the paused cells.
void place(Chunk chunk, std::span<const uint32_t> slots, Chunk& tree);

}  // namespace csgcore
