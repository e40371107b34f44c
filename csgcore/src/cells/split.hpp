// The choice of the plane that divides a cell in two.
#pragma once

#include <cstdint>

#include "csgcore/canonical_primitive.hpp"
#include "tree/cell_list.hpp"

namespace csgcore {

struct Split {
  uint32_t axis;
  double position;
};

/// Returns the middle of axis depth mod 3 (paper §2.1).
Split cyclic_split(const Box& cell, uint32_t depth);

/// Returns the middle of the longest axis.
Split longest_split(const Box& cell);

/// Returns the plane of least Σ (surface area of a side · primitives whose boxes reach into it),
/// which is the expected cost of a ray that enters the cell (MacDonald and Booth, "Heuristics for
/// ray tracing using space subdivision", 1990). The candidates are evenly spaced planes of every
/// axis. If none is better than the middle of the longest axis, that is returned.
Split surface_area_split(std::span<const Extent> extents, const CellList& list, const Box& cell);

}  // namespace csgcore
