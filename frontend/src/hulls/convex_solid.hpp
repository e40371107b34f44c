// From generators of a convex body to primitives.
#pragma once

#include <vector>

#include "csgcore/primitive.hpp"
#include "hulls/generator.hpp"

namespace frontend {

/// Primitives whose union is a convex body. Each lies within it, up to rounding.
struct ConvexSolid {
  std::vector<csgcore::Primitive> pieces;
  bool is_faceted = false;  // facets, finer than a pixel, stand for something round
};

/// Returns the hull of finite generators. It is empty if they lie on a line, and a thin sheet if
/// they lie in a plane.
ConvexSolid convex_solid(const Generators& generators);

}  // namespace frontend
