// Which surfaces do not cross or touch themselves.
#pragma once

#include <vector>

#include "arrangement/facet_grid.hpp"

namespace csgcore {

/// Returns by operand whether its surface may cross itself or touch itself, or be in several
/// pieces: one may that is neither said to be simple, without facets that rounding has left without
/// area and none that it can have folded over others, nor the boundary of a convex solid. Others
/// are turned so that their facets face outwards.
std::vector<bool> find_simple_surfaces(Surfaces operands, Facets& facets);

}  // namespace csgcore
