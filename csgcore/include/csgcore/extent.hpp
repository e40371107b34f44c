// How far a primitive reaches, in one cache line: all that the subdivision reads of most primitives
// that it tests against a cell.
#pragma once

#include <vector>

#include "csgcore/canonical_primitive.hpp"

namespace csgcore {

/// The primitive lies within the box center ± half. A ball is decided by distances from the centre
/// alone: a cell lies outside of it if the cell's nearest point is further away than √outside2, and
/// inside if the cell's furthest point is nearer than √inside2. For primitives that are no balls
/// outside2 = +inf and inside2 = −1, which decide nothing. World units.
struct alignas(64) Extent {
  double center[3];
  double half[3];
  double outside2;
  double inside2;
};

using Extents = std::vector<Extent>;

Extent extent_of(const CanonicalPrimitive& primitive);

}  // namespace csgcore
