// How far a primitive reaches: what the subdivision reads of every primitive that it tests against
// a cell, in one cache line.
#pragma once

#include <vector>

#include "csgcore/canonical_primitive.hpp"

namespace csgcore {

/// The primitive lies within center ± half. A true ball is decided by distances from the centre
/// alone: a cell is outside where its nearest point is further than √outside2, and inside where its
/// furthest is nearer than √inside2. For other shapes outside2 is +inf and inside2 −1, which decide
/// nothing.
struct alignas(64) Extent {
  double center[3];
  double half[3];
  double outside2;
  double inside2;
};

using Extents = std::vector<Extent>;

Extent extent_of(const CanonicalPrimitive& primitive);

}  // namespace csgcore
