// The tests that a division makes of all its primitives, several at a time. Each answer depends on
// its own primitive only, by the same operations whatever the width of the vectors.
#pragma once

#include <cstdint>

#include "csgcore/extent.hpp"
#include "solid/soa_bounds.hpp"
#include "tree/cell_list.hpp"

namespace csgcore {

/// The lowest bits of a word; 1 ≤ count ≤ 64.
constexpr uint64_t first_bits(uint32_t count) { return ~uint64_t{0} >> (64 - count); }

/// The two sides of a cell that is divided; they differ in one axis only.
struct Halves {
  Box below, above;
  uint32_t axis = 0;
};

/// Answers for up to 64 primitives, bit i for the i-th.
struct ExtentAnswers {
  uint64_t outside[2];  // certainly outside the half below, above
  uint64_t inside[2];   // the half lies certainly inside
  uint64_t open;        // not balls: what stands in neither is undecided
};

/// 1 ≤ count ≤ 64.
ExtentAnswers test_extents(const Extent* extents, const uint32_t* primitives, uint32_t count,
                           const Halves& halves);

/// The bits of those that lie outside of the box's x and y, closed as they are. 1 ≤ count ≤ 64.
uint64_t find_outside(const RectangleRows& rows, uint32_t count, const Box& cell);

/// Bins of equal width across each axis of a cell. More of them cost more to count than the better
/// plane saves.
constexpr int kSplitBins = 8;

/// For each axis and bin, how many boxes start and end in it; what lies beyond the cell counts in
/// the first or last bin.
struct EndCounts {
  uint32_t starts[3][kSplitBins];
  uint32_t ends[3][kSplitBins];
};

/// The cell's sides are longer than 0.
void count_ends(const Extent* extents, const uint32_t* primitives, uint32_t count, const Box& cell,
                EndCounts& counts);

}  // namespace csgcore
