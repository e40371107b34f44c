// A list as the expression that it was compiled from: which operations its tests are operands
// of.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "tree/cell_list.hpp"

namespace csgcore {

/// The steps that evaluate an expression on a stack. A subtraction is an intersection with a
/// complement, which its tests are.
class ListExpression {
 public:
  enum class Step : uint8_t {
    kTest,          // pushes the next test, by its index in the CellList from 0 on
    kIntersection,  // makes one operand of the last two
    kUnion,
  };

  /// Reads a list that a tree was compiled to, or that restriction has left of one. A block of
  /// tests that follow each other is an operand of the next one if its tests lead to the
  /// start of that one and else where that one leads, and no others lead to its start.
  void parse(const CellList& list);

  std::span<const Step> steps() const { return steps_; }

 private:
  /// Tests that stand side by side, and together have two continuations.
  struct Block {
    uint32_t entry;                    // number of the first
    uint32_t if_true, if_false;        // numbers
    uint32_t true_jumps, false_jumps;  // how many of the tests lead there
  };
  bool combine(Block& block, const Block& next);

  std::vector<Step> steps_;
  std::vector<Block> blocks_;    // not yet operands, the last of which comes first in the list
  std::vector<uint32_t> jumps_;  // by number: how many tests lead there
};

/// What becomes of an operand at crossings that coincide (NUMERICS.md, "The definition"): a number,
/// by which operations compare. Anything else than these is the index of the primitive by which the
/// operand turns.
namespace turning {
constexpr int32_t kFails = -2;                                   // it is false before and behind
constexpr int32_t kEnds = -1;                                    // true before, false behind
constexpr int32_t kHolds = std::numeric_limits<int32_t>::max();  // true before and behind
constexpr bool is_turned(int32_t state) { return state >= 0 && state != kHolds; }

constexpr int32_t state_of(bool before, bool behind, uint32_t primitive) {
  if (!behind) return before ? kEnds : kFails;
  return before ? kHolds : static_cast<int32_t>(primitive);
}
/// The last of those that turn is shown. Where one operand ends as another one turns, the union
/// holds.
constexpr int32_t union_of(int32_t a, int32_t b) {
  const int32_t last = a > b ? a : b;
  const int32_t first = a > b ? b : a;
  return first == kEnds && last >= 0 ? kHolds : last;
}
/// What holds all along does not count. Where one operand ends as another one turns, the
/// intersection fails.
constexpr int32_t intersection_of(int32_t a, int32_t b) {
  const int32_t last = a > b ? a : b;
  const int32_t first = a > b ? b : a;
  if (last == kHolds || first == last) return first;
  return first < 0 ? kFails : last;
}
}  // namespace turning

}  // namespace csgcore
