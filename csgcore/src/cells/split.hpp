// Where a cell is divided in two.
#pragma once

#include <cstdint>

#include "csgcore/extent.hpp"
#include "tree/cell_list.hpp"

namespace csgcore {

struct Split {
  uint32_t axis;
  double position;
};

/// Paper §2.1: the middle of axis depth mod 3.
Split cyclic_split(const Box& cell, uint32_t depth);

/// The middle of the longest axis.
Split longest_split(const Box& cell);

/// The plane of least Σ (surface area of a side · primitives whose boxes reach into it), the
/// expected cost of a ray that enters the cell (MacDonald and Booth, "Heuristics for ray tracing
/// using space subdivision", 1990), among evenly spaced planes of every axis; the middle of the
/// longest axis where no plane separates anything.
Split surface_area_split(std::span<const Extent> extents, const CellList& list, const Box& cell);

}  // namespace csgcore
