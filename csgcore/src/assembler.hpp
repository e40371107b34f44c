// Puts the parts of a kd-tree together.
#pragma once

#include "builder.hpp"

namespace csgcore {

/// Appends parts in the order in which one task alone would have produced them: a node before its
/// two sides, the one below first.
class Assembler {
 public:
  /// Keeps a reference.
  explicit Assembler(Chunk& all) : all_(all) {}

  /// Puts the part's root at `slot`, and the rest behind all nodes.
  void place(const Part& part, uint32_t slot);

 private:
  uint32_t new_slot();
  void append_chunk(const Chunk& chunk, uint32_t slot);

  Chunk& all_;
};

}  // namespace csgcore
