// Traces one ray by the CPU, through the cells of a kd-tree.
#pragma once

#include "csgcore/subdivision.hpp"
#include "seen_ray.hpp"

namespace validation {

/// Returns what the only pixel of the view sees.
Seen traced_ray(const csgcore::Subdivision& subdivision, const csgcore::View& view);

}  // namespace validation
