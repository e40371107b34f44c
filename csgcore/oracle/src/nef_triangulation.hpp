// Facets with holes, in triangles.
#pragma once

#include <array>
#include <vector>

#include "nef_kernel.hpp"

namespace oracle {

/// A plane polygon, possibly with holes: closed cycles of indices of points, in any order. An edge
/// that they run along twice, to and fro, has the polygon on both of its sides.
struct Facet {
  Vector normal;
  std::vector<std::vector<std::size_t>> cycles;
};

/// Appends triangles that turn counterclockwise about the normal. They have the facet's corners and
/// no others.
void triangulate(const Facet& facet, const std::vector<Point>& points,
                 std::vector<std::array<std::size_t, 3>>& triangles);

}  // namespace oracle
