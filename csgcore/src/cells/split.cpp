#include "cells/split.hpp"

#include "solid/extent_tests.hpp"

namespace csgcore {
namespace {

/// A plane must cost less than the middle by this factor: boxes promise more than the shapes in
/// them keep, and halving leads faster to where surfaces meet. The exact value hardly matters:
/// between 0.95 and 1 the numbers of cells of CSn and CCn change by 1%. A value below 1 does not
/// leave ties to rounding.
constexpr double kWorthwhile = 0.97;

double area(const Vec3& size) { return size.x * size.y + size.y * size.z + size.z * size.x; }

uint32_t longest_axis(const Vec3& size) {
  if (size.x >= size.y) return size.x >= size.z ? 0 : 2;
  return size.y >= size.z ? 1 : 2;
}

}  // namespace

Split cyclic_split(const Box& cell, uint32_t depth) {
  const uint32_t axis = depth % 3;
  return {axis, cell.center()[static_cast<int>(axis)]};
}

Split longest_split(const Box& cell) {
  const uint32_t axis = longest_axis(cell.size());
  return {axis, cell.center()[static_cast<int>(axis)]};
}

Split surface_area_split(std::span<const Extent> extents, const CellList& list, const Box& cell) {
  EndCounts counts;
  count_ends(extents.data(), list.primitive.data(), list.count(), cell, counts);
  const Vec3 size = cell.size();
  Split best = longest_split(cell);
  // A plane must beat the middle of the longest axis, with all primitives in both halves.
  Vec3 half = size;
  half[static_cast<int>(best.axis)] *= 0.5;
  double best_cost = kWorthwhile * 2.0 * area(half) * static_cast<double>(list.count());
  for (int axis = 0; axis < 3; ++axis) {
    // A side's area has a term that does not depend on the plane, and one in proportion to the
    // side's width.
    const double across = size[(axis + 1) % 3] * size[(axis + 2) % 3];
    const double along = (size[(axis + 1) % 3] + size[(axis + 2) % 3]) * size[axis] / kSplitBins;
    // A box that starts before a plane reaches below it; one that has not ended before it reaches
    // above it.
    uint32_t below = 0;
    uint32_t above = list.count();
    for (int plane = 1; plane < kSplitBins; ++plane) {
      below += counts.starts[axis][plane - 1];
      above -= counts.ends[axis][plane - 1];
      const double cost =
          (across + along * plane) * below + (across + along * (kSplitBins - plane)) * above;
      if (cost < best_cost) {
        best_cost = cost;
        best = {static_cast<uint32_t>(axis), cell.min[axis] + size[axis] * plane / kSplitBins};
      }
    }
  }
  return best;
}

}  // namespace csgcore
