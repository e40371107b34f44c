// What is too small to exist in a solid, and what rounding may displace.
#pragma once

#include "csgcore/geometry.hpp"

namespace csgcore {

/// Thinnest piece of a solid of these bounds, and narrowest gap in it, that exists: a thickness
/// along the normal, in world units (NUMERICS.md, "The definition").
double thickness_tolerance(const Box& solid_bounds);

/// How far beyond a cell its function is valid (Subdivision::overlap), for a solid of these bounds.
double cell_overlap(const Box& solid_bounds);

}  // namespace csgcore
