// The two tolerances that are fitted to a solid's size.
#pragma once

#include "csgcore/geometry.hpp"

namespace csgcore {

/// Returns the thickness tolerance τ of a solid with these bounds, in world units. Pieces and gaps
/// that are thinner along the surface normal do not exist (NUMERICS.md, "The definition").
double thickness_tolerance(const Box& solid_bounds);

/// Returns how far beyond a cell its function is valid (Subdivision::overlap), in world units, for
/// a solid with these bounds; 0 if they are empty.
double cell_overlap(const Box& solid_bounds);

}  // namespace csgcore
