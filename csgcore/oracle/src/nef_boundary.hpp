// The boundary of a solid, exactly.
#pragma once

#include <array>
#include <iosfwd>
#include <span>
#include <vector>

#include "nef_polytope.hpp"

namespace oracle {

/// Triangles are counterclockwise as seen from outside, and none is degenerate. Several vertices
/// may be equal.
struct ExactBoundary {
  std::vector<Point> vertices;
  std::vector<std::array<std::size_t, 3>> triangles;
};

/// Returns the boundary of the regularised solid of the tree, by Nef polyhedra. Its time has no
/// limit.
ExactBoundary nef_boundary(const csgcore::CsgTree& tree, std::span<const FacetedSolid> polyhedra);

/// Writes the boundary as text with all digits, for another process to read.
void write_boundary(std::ostream& out, const ExactBoundary& boundary);
/// Reads a boundary. Throws std::runtime_error if the text ends early.
ExactBoundary read_boundary(std::istream& in);

}  // namespace oracle
