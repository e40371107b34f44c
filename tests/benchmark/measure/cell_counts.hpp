// What §4.1 of the paper says that T_R depends on.
#pragma once

#include <cstdint>

#include "bench/measurement.hpp"

namespace measure {

struct CellCounts {
  uint64_t cells = 0;          // with a surface in them
  uint64_t cells_in_view = 0;  // of these, whose bounds on the screen are in the picture
  /// The depth complexity: so many cells the rays of the pixels that show the solid pass through,
  /// on average.
  double cells_per_pixel = 0;
};

CellCounts count_cells(const csgcore::Scene& scene, const csgcore::View& view,
                       const bench::Rule& rule);

}  // namespace measure
