// The boundary of a solid, exactly.
#pragma once

#include <array>
#include <iosfwd>
#include <span>
#include <vector>

#include "nef_kernel.hpp"

namespace oracle {

/// Triangles turn counterclockwise seen from outside. None is degenerate. A vertex may be there
/// more than once.
struct ExactBoundary {
  std::vector<Point> vertices;
  std::vector<std::array<std::size_t, 3>> triangles;
};

/// Of the regularised solid of the tree, by Nef polyhedra. Takes as long as it takes.
ExactBoundary nef_boundary(const csgcore::CsgTree& tree,
                           std::span<const ConvexPolyhedron> polyhedra);

/// As text, with all digits: out of one process and into another.
void write_boundary(std::ostream& out, const ExactBoundary& boundary);
/// Throws std::runtime_error if it is cut short.
ExactBoundary read_boundary(std::istream& in);

}  // namespace oracle
