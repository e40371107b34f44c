// The box of a circle in OpenSCAD's facets.
#pragma once

#include "csgcore/geometry.hpp"

namespace frontend {

/// The box of the regular polygon of so many vertices (≥ 3) whose vertex 0 is (1, 0); its z is 0.
/// A call with the same number as the last one in this thread computes nothing. The reference is
/// valid until the thread's next call.
const csgcore::Box& unit_polygon_box(int fragments);

}  // namespace frontend
