// Tests of the extents of many primitives against cells, in vectors. The answer for a primitive
// depends on that primitive alone, and is the same for every width of the vectors.
#pragma once

#include <cstdint>

#include "csgcore/canonical_primitive.hpp"
#include "tree/cell_list.hpp"

namespace csgcore {

// SoA bounds: simple bounds of a group's members in structures of arrays, for vectors of float.

/// Vectors read up to so many entries beyond the last one of a row.
constexpr uint32_t kRowPadding = 16;

/// Balls, in world units.
struct BallRows {
  const float* x;
  const float* y;
  const float* z;
  const float* radius;
};

/// Rectangles on the screen, in pixels.
struct RectangleRows {
  const float* low_x;
  const float* high_x;
  const float* low_y;
  const float* high_y;
};

/// The lowest `count` bits of a word, 1 ≤ count ≤ 64.
constexpr uint64_t first_bits(uint32_t count) { return ~uint64_t{0} >> (64 - count); }

/// The two halves of a divided cell. They differ along one axis only.
struct Halves {
  Box below, above;
  uint32_t axis = 0;
};

/// Answers for up to 64 primitives, bit i for the i-th.
struct ExtentAnswers {
  uint64_t outside[2];  // the primitive certainly lies outside of the half below, above
  uint64_t inside[2];   // the half certainly lies inside the primitive
  uint64_t open;        // no balls: undecided unless they are outside or inside
};

/// Tests extents[primitives[i]] against both halves, for 0 ≤ i < count, 1 ≤ count ≤ 64. The top
/// bits of `primitives` are ignored, and kVectorPadding valid indices must follow them.
ExtentAnswers test_extents(const Extent* extents, const uint32_t* primitives, uint32_t count,
                           const Halves& halves);

/// Returns the bits of the rectangles that are disjoint from the cell's x and y ranges; all of
/// these are closed. 1 ≤ count ≤ 64.
uint64_t find_outside(const RectangleRows& rows, uint32_t count, const Box& cell);

/// The number of bins of equal width along each axis of a cell. More bins would cost more to count
/// than the better plane saves.
constexpr int kSplitBins = 8;

/// For each axis and bin, the numbers of boxes that start and that end in it. An end beyond the
/// cell counts in the first or last bin.
struct EndCounts {
  uint32_t starts[3][kSplitBins];
  uint32_t ends[3][kSplitBins];
};

/// Counts the ends of the boxes of extents[primitives[i]] along each axis of the cell, whose sides
/// must be longer than 0. The padding is as for test_extents().
void count_ends(const Extent* extents, const uint32_t* primitives, uint32_t count, const Box& cell,
                EndCounts& counts);

}  // namespace csgcore
