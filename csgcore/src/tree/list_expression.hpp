// A Boolean list as the expression that it was compiled from.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "tree/cell_list.hpp"

namespace csgcore {

/// The steps that evaluate a list's expression on a stack. A subtraction is an intersection whose
/// subtracted operand consists of complement tests.
class ListExpression {
 public:
  enum class Step : uint8_t {
    kTest,          // pushes the next test, in the order of CellList's indices
    kIntersection,  // replaces the top two operands by one, as kUnion does
    kUnion,
  };

  /// Reads a list that was compiled from a tree, or a restriction of such a list. A block of
  /// adjacent tests and the block after it are operands of one operation under two conditions: each
  /// jump out of the first block leads to the start of the second one or to where the second one
  /// leads, too; and no other jumps lead to the start of the second block.
  void parse(const CellList& list);

  std::span<const Step> steps() const { return steps_; }

 private:
  /// Adjacent tests whose jumps out of the block have two targets.
  struct Block {
    uint32_t entry;                    // number of the test where the block is entered
    uint32_t if_true, if_false;        // numbers
    uint32_t true_jumps, false_jumps;  // how many jumps lead there
  };
  bool combine(Block& block, const Block& next);

  std::vector<Step> steps_;
  std::vector<Block> blocks_;    // no operands yet; the last one comes first in the Blist
  std::vector<uint32_t> jumps_;  // by number: how many jumps lead there
};

/// The states of an operand at a coincidence (NUMERICS.md, "The definition"), as numbers that
/// operations compare. A number other than these three means that the operand turns (false before,
/// true behind), and is the index of the primitive by which it does.
namespace turning {
constexpr int32_t kFails = -2;                                   // false before and behind
constexpr int32_t kEnds = -1;                                    // true before, false behind
constexpr int32_t kHolds = std::numeric_limits<int32_t>::max();  // true before and behind
constexpr bool is_turned(int32_t state) { return state >= 0 && state != kHolds; }

constexpr int32_t state_of(bool before, bool behind, uint32_t primitive) {
  if (!behind) return before ? kEnds : kFails;
  return before ? kHolds : static_cast<int32_t>(primitive);
}
/// If several operands turn, the union turns by the primitive that is last in file order. If one
/// operand ends as another one turns, the union holds.
constexpr int32_t union_of(int32_t a, int32_t b) {
  const int32_t last = a > b ? a : b;
  const int32_t first = a > b ? b : a;
  return first == kEnds && last >= 0 ? kHolds : last;
}
/// An operand that holds throughout does not count. If one operand ends as another one turns, the
/// intersection fails.
constexpr int32_t intersection_of(int32_t a, int32_t b) {
  const int32_t last = a > b ? a : b;
  const int32_t first = a > b ? b : a;
  if (last == kHolds || first == last) return first;
  return first < 0 ? kFails : last;
}
}  // namespace turning

}  // namespace csgcore
