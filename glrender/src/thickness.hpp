// Primitives that are too thin to exist in a picture by OpenGL.
#pragma once

#include "csgcore/canonical_primitive.hpp"

namespace glrender {

/// Whether the primitive lies between two parallel planes less than `thickness` apart. Of a
/// polyhedron only the planes of its faces are looked at, which are those of what is flat.
bool is_thinner(const csgcore::CanonicalPrimitive& primitive, double thickness);

}  // namespace glrender
