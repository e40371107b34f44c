// Surfaces as files hold them: rounded to the file's numbers.
#pragma once

#include <cstdint>
#include <string>

#include "csgcore/boundary_mesh.hpp"

namespace frontend {

/// The numbers that a format has, or that its readers take.
enum class Precision : uint8_t { kFloat, kDouble };

/// Returns the surface with each coordinate as the file holds it, and without what collapses by
/// that: two vertices of a triangle that are the same become one, the triangle goes, and so do two
/// triangles that then are one another's back. A closed surface stays closed. Other vertices stay
/// apart, even if their places are the same. Throws Error about the design of that name if a
/// coordinate is too large.
csgcore::TriangleSet written_mesh(const csgcore::TriangleSet& surface, Precision precision,
                                  const std::string& name);

}  // namespace frontend
