// The kinds of primitives, and the numbers of each: what makes its local solid.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <variant>

namespace csgcore {

class Polyhedron;
class Profile;
class TriangleMesh;

/// A ball about the local origin.
struct SphereShape {
  double radius = 0;
  auto operator<=>(const SphereShape&) const = default;
};

/// Local z in [z_min, z_max]; the radius is r_bottom at z_min, r_top at z_max, and linear between.
/// Where it is 0 the solid is pointed.
struct FrustumShape {
  double z_min = 0, z_max = 0;  // z_min < z_max
  double r_bottom = 0, r_top = 0;
  auto operator<=>(const FrustumShape&) const = default;
};

/// The convex solid.
struct PolyhedronShape {
  std::shared_ptr<const Polyhedron> polyhedron;
  auto operator<=>(const PolyhedronShape&) const = default;
};

/// The solid that the triangles enclose, or the sheets that they are.
struct MeshShape {
  std::shared_ptr<const TriangleMesh> mesh;
  auto operator<=>(const MeshShape&) const = default;
};

/// Local z in [z_min, z_max]; the cross-section at z is the profile, scaled about the z axis by a
/// factor that is scale_bottom at z_min, scale_top at z_max, and linear between. Both are ≥ 0, and
/// one of them is > 0.
struct ExtrusionShape {
  std::shared_ptr<const Profile> profile;
  double z_min = 0, z_max = 0;  // z_min < z_max
  double scale_bottom = 1, scale_top = 1;
  auto operator<=>(const ExtrusionShape&) const = default;
};

/// The profile turned about the z axis, with x as the radius and y as z. No point of it has x < 0.
struct RevolutionShape {
  std::shared_ptr<const Profile> profile;
  auto operator<=>(const RevolutionShape&) const = default;
};

/// These list the kinds of primitives, X(Name) for Shape::kName and NameShape: those of convex
/// solids, which a ray meets in one segment at most, and the others, which it may meet in any
/// number of them. All code that answers for a kind is looked up by this list, so that a kind for
/// which some of it is missing does not build (CONTRIBUTING.md, "Adding a primitive").
#define CSGCORE_FOR_EACH_CONVEX_SHAPE(X) X(Sphere) X(Frustum) X(Polyhedron)
#define CSGCORE_FOR_EACH_OTHER_SHAPE(X) X(Mesh) X(Extrusion) X(Revolution)
#define CSGCORE_FOR_EACH_SHAPE(X)  \
  CSGCORE_FOR_EACH_CONVEX_SHAPE(X) \
  CSGCORE_FOR_EACH_OTHER_SHAPE(X)

#define CSGCORE_ENUMERATOR(Name) k##Name,
enum class Shape : uint8_t { CSGCORE_FOR_EACH_SHAPE(CSGCORE_ENUMERATOR) };
#undef CSGCORE_ENUMERATOR

/// Returns whether all solids of the kind are convex.
constexpr bool is_convex(Shape shape) {
  switch (shape) {
#define CSGCORE_CASE(Name) case Shape::k##Name:
    CSGCORE_FOR_EACH_OTHER_SHAPE(CSGCORE_CASE)
#undef CSGCORE_CASE
    return false;
    default:
      return true;
  }
}

/// Makes the variant of all NameShape: a leading void, which is left out, saves a special case.
template <class None, class... Shapes>
struct VariantOf {
  using Type = std::variant<Shapes...>;
};
#define CSGCORE_ALTERNATIVE(Name) , Name##Shape
/// A local solid of any kind; its index is the kind's place in Shape. Equal ones are the same
/// solid, though equal solids may be shared by different pointers.
using LocalSolid = VariantOf<void CSGCORE_FOR_EACH_SHAPE(CSGCORE_ALTERNATIVE)>::Type;
#undef CSGCORE_ALTERNATIVE

}  // namespace csgcore
