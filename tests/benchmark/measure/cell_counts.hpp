// Counts what T_R depends on, according to §4.1 of the paper.
#pragma once

#include <cstdint>

#include "bench/measurement.hpp"

namespace measure {

struct CellCounts {
  uint64_t cells = 0;          // with a surface in them
  uint64_t cells_in_view = 0;  // those whose bounds on the screen are in the picture
  /// The depth complexity: the average number of cells that the rays of pixels which show the solid
  /// pass through.
  double cells_per_pixel = 0;
};

CellCounts count_cells(const csgcore::Scene& scene, const csgcore::View& view,
                       const bench::Rule& rule);

}  // namespace measure
