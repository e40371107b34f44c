// One ray by the CPU tracer, through the cells of a kd-tree.
#pragma once

#include "csgcore/subdivision.hpp"
#include "seen_ray.hpp"

namespace validation {

/// What the only pixel of the view sees.
Seen traced_ray(const csgcore::Subdivision& subdivision, const csgcore::View& view);

}  // namespace validation
