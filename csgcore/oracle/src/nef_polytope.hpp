// The exact vertices and facets of a convex polyhedron.
#pragma once

#include "nef_kernel.hpp"

namespace oracle {

/// The corners of a facet lie exactly in its plane, counterclockwise as seen from outside.
struct Polytope {
  std::vector<Point> vertices;
  std::vector<std::vector<std::size_t>> facets;
};

/// Returns the polytope in world coordinates. Throws std::invalid_argument if the half-spaces have
/// no common interior, or an unbounded one.
Polytope polytope_of(const FacetedSolid& polyhedron);

}  // namespace oracle
