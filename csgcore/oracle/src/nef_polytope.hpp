// The exact vertices and facets of a convex polyhedron.
#pragma once

#include "nef_kernel.hpp"

namespace oracle {

/// A polygon's corners lie exactly in its plane, counterclockwise seen from outside.
struct Polytope {
  std::vector<Point> vertices;
  std::vector<std::vector<std::size_t>> facets;
};

/// In world coordinates. Throws std::invalid_argument where the half-spaces have no common
/// interior, or bound no solid.
Polytope polytope_of(const ConvexPolyhedron& polyhedron);

}  // namespace oracle
