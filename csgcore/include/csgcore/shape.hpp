// The kinds of primitives.
#pragma once

#include <cstdint>

/// These list the kinds of primitives, X(Name) for Shape::kName: those of convex solids, which a
/// ray meets in one segment at most, and the others, which it may meet in any number of them. All
/// code that answers for a kind is looked up by this list, so that a kind for which some of it is
/// missing does not build (CONTRIBUTING.md, "Adding a primitive"). The dimensions are members of
/// Primitive (primitive.hpp):
///
/// Sphere: centred at the local origin, radius r_bottom.
///
/// Frustum: local z in [z_min, z_max]; radius r_bottom at z_min, r_top at z_max, linear between.
///
/// Polyhedron: the convex solid that `polyhedron` points to.
///
/// Mesh: the solid that `mesh` points to.
///
/// Extrusion: local z in [z_min, z_max]; the cross-section at z is `profile` scaled about the z
/// axis by a factor that is r_bottom at z_min, r_top at z_max, and linear between.
///
/// Revolution: `profile` turned about the z axis, with x as the radius and y as z.
#define CSGCORE_FOR_EACH_CONVEX_SHAPE(X) X(Sphere) X(Frustum) X(Polyhedron)
#define CSGCORE_FOR_EACH_OTHER_SHAPE(X) X(Mesh) X(Extrusion) X(Revolution)
#define CSGCORE_FOR_EACH_SHAPE(X)  \
  CSGCORE_FOR_EACH_CONVEX_SHAPE(X) \
  CSGCORE_FOR_EACH_OTHER_SHAPE(X)

namespace csgcore {

#define CSGCORE_ENUMERATOR(Name) k##Name,
enum class Shape : uint8_t { CSGCORE_FOR_EACH_SHAPE(CSGCORE_ENUMERATOR) };
#undef CSGCORE_ENUMERATOR

}  // namespace csgcore
