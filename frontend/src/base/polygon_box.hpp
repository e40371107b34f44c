// The box of a circle in OpenSCAD's facets.
#pragma once

#include "csgcore/geometry.hpp"

namespace frontend {

/// Returns the box of the regular polygon with `fragments` (≥ 3) vertices on the unit circle, the
/// first at (1, 0); its z is 0. A call with the same number as the thread's last one computes
/// nothing. The reference is valid until the thread's next call.
const csgcore::Box& unit_polygon_box(int fragments);

}  // namespace frontend
