// Restricting a short-circuit list to a cell (paper §2.2.1).
#pragma once

#include <span>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/short_circuit_list.hpp"

namespace csgcore {

/// Working memory of `Restrictor`, and the stack on which nested cells keep their lists.
class Restrictor {
 public:
  explicit Restrictor(std::span<const CanonicalPrimitive> primitives) : primitives_(primitives) {}

  /// The simplest list that equals `list` within `cell`, appended to `out`, to which `list` must not
  /// point. Returns kListTrue or kListFalse if that is constant (nothing is appended then), else the
  /// number of literals appended.
  uint32_t restrict(std::span<const Literal> list, const Box& cell, std::vector<Literal>& out);

 private:
  enum class State : uint8_t { kUnreached, kReached, kInside, kOutside, kCrosses };

  void classify_reached(std::span<const Literal> list, const Box& cell);
  uint32_t resolve(uint32_t target) const { return target >= kListFalse ? target : map_[target]; }

  std::span<const CanonicalPrimitive> primitives_;
  std::vector<State> states_;
  std::vector<uint32_t> map_;   // per literal: the literal that stands for it, or a constant
  std::vector<Literal> kept_;   // what remains, last literal first
  std::vector<uint32_t> kept_index_;
};

}  // namespace csgcore
