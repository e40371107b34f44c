// The box of a circle in OpenSCAD's facets.
#pragma once

#include "csgcore/geometry.hpp"

namespace frontend {

/// Of the regular polygon of so many vertices (≥ 3) whose vertex 0 is (1, 0); z is 0. Cheap if the
/// last call in this thread had the same number.
const csgcore::Box& unit_polygon_box(int fragments);

}  // namespace frontend
