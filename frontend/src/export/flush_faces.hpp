// Which operands of a solid have faces in one plane.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/triangle_set.hpp"

namespace frontend {

/// The planes that faces of several operands are in, but for rounding.
class FlushFaces {
 public:
  /// `candidates` are the operands that count, each once.
  FlushFaces(std::span<const csgcore::TriangleSet> operands, std::span<const uint32_t> candidates);

  bool empty() const { return planes_of_.empty(); }
  /// Returns whether two different ones of the operands have faces in one plane.
  bool are_among(std::span<const uint32_t> operands) const;

 private:
  std::vector<std::vector<uint32_t>> planes_of_;  // by operand: numbers, ascending
};

}  // namespace frontend
