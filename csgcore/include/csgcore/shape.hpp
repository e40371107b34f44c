// The kinds of primitives.
#pragma once

#include <cstdint>

/// One X(Name) a kind, which is Shape::kName. The exact twins of the oracle are looked up by this
/// list, so that a kind that lacks one does not build (CONTRIBUTING.md, "Adding a primitive").
///
/// Sphere: centred at the local origin, radius r_bottom.
///
/// Frustum: local z in [z_min, z_max]; radius r_bottom at z_min, r_top at z_max, linear between.
///
/// Polyhedron: convex; `polyhedron`.
#define CSGCORE_FOR_EACH_SHAPE(X) X(Sphere) X(Frustum) X(Polyhedron)

namespace csgcore {

#define CSGCORE_ENUMERATOR(Name) k##Name,
enum class Shape : uint8_t { CSGCORE_FOR_EACH_SHAPE(CSGCORE_ENUMERATOR) };
#undef CSGCORE_ENUMERATOR

}  // namespace csgcore
