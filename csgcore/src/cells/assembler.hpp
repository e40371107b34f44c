// Puts the pieces of a kd-tree together.
#pragma once

#include <memory>
#include <span>

#include "cells/chunk.hpp"

namespace csgcore {

/// The whole tree as the one chunk that one task alone, with no cell paused, would have produced.
Chunk assemble(std::unique_ptr<Part> part);

/// Puts the subtrees of `chunk` in the places of the nodes `slots` of `tree`: the root of each at
/// its slot, and the rest behind all that `tree` holds. What was resumed stands in the place of
/// what was paused.
void place(Chunk chunk, std::span<const uint32_t> slots, Chunk& tree);

}  // namespace csgcore
