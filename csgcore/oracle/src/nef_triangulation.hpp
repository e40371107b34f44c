// The triangulation of facets with holes.
#pragma once

#include <array>
#include <vector>

#include "nef_kernel.hpp"

namespace oracle {

/// A plane polygon, possibly with holes: closed cycles of indices of points, in any order. An edge
/// that cycles run along in both directions has the polygon on both of its sides.
struct Facet {
  Vector normal;
  std::vector<std::vector<std::size_t>> cycles;
};

/// Appends triangles, counterclockwise about the normal, whose corners are those of the facet.
void triangulate(const Facet& facet, const std::vector<Point>& points,
                 std::vector<std::array<std::size_t, 3>>& triangles);

}  // namespace oracle
