// Segments of lines that are drawn in a plane.
#pragma once

#include <cstdint>
#include <vector>

#include "arrangement/planar_subdivision.hpp"

namespace csgcore {

struct DrawnSegment {
  uint32_t line;  // segments of equal numbers are on one line
  uint32_t met;   // the facet that meets the plane there; kNoPlace: several do
  uint32_t from;  // points, which are not the same
  uint32_t to;
};

/// Makes segments one that overlap on their line; the others stay in their order. Where a facet
/// meets n facets of one plane along its edge, it has n of them, each of which would be drawn over
/// the ends of all others.
void join_overlaps(const std::vector<ArrangedPoint>& points, std::vector<DrawnSegment>& segments);

}  // namespace csgcore
