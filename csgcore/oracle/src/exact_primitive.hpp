// The intersection of one ray with one primitive, by the same formulas in exact arithmetic and in
// intervals.
//
// A ray x(t) = origin + t·direction, relative to a pivot near the model, is mapped to o + t·d in
// the primitive's local space, relative to the primitive's middle and magnified by λ > 0. (λ is a
// power of two times |det M| for the local→world matrix M, so that no quotients are needed.) There
// the solids are
//   sphere:  |o + t·d|² ≤ (λr)²
//   frustum: |z| ≤ λk, (2k)²(x² + y²) ≤ ρ(z)², ρ(z) = λk(r₀ + r₁) + (r₁ − r₀)z
//   polyhedron: n·(o + t·d) ≤ λ(offset − n·middle) for all its half-spaces
//   mesh: see exact_mesh.hpp
//   extrusion and revolution: see exact_profile.hpp
// A frustum has half the height k and the radii r₀ below and r₁ above; ρ(z) is 2kλ times the radius
// at z, and not negative within the slab. The wall's inequality is scaled by a power of four, a
// half-space's by a power of two.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "csgcore/primitive.hpp"
#include "exact_number.hpp"

namespace oracle {

template <class Number>
using Vector = std::array<Number, 3>;

inline csgcore::Vec3 middle(const Vector<Interval>& v) {
  return {middle(v[0]), middle(v[1]), middle(v[2])};
}

template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A ray relative to the pivot, in world space in the prepared unit.
template <class Number>
struct NearRay {
  Vector<Number> origin, direction;
};

/// The half-space normal·x ≤ limit.
template <class Number>
struct Plane {
  Vector<Number> normal;  // its largest coordinate is in [1, 2)
  Number limit;
};

/// The walls by which a ray enters a primitive and leaves it. A kind of one wall names it twice. Of
/// a kind of several walls the ray misses the primitive if it misses either, and each a is > 0.
template <class Number>
struct Walls {
  Quadratic<Number> enter, leave;
};

/// What the oracles ask of a kind of primitive (exact_twin.hpp).
class ExactTwin;
/// The triangles of a mesh (exact_mesh.hpp).
class ExactMesh;
/// The solid of a profile (exact_profile.hpp).
class ExactProfile;

/// A valid primitive, prepared for rays relative to a pivot. A convex one is the solid within its
/// wall, if it has one, and within all its planes. If it has both, the first two planes are a slab
/// across the z axis.
template <class Number>
struct Target {
  const ExactTwin* twin = nullptr;
  bool has_wall = false;
  std::array<Vector<Number>, 3> to_local;  // the rows of λM⁻¹
  Vector<Number> from_middle;         // from the local solid's middle to the pivot, in world space
  Number radius;                      // of the wall: λr, or λk(r₀ + r₁)
  Number growth, squared_height;      // r₁ − r₀ and (2k)², for a frustum's wall
  std::vector<Plane<Number>> planes;  // a frustum's bottom and top; a polyhedron's faces
  // A mesh or a profile's solid, which has neither wall nor planes; else null:
  std::shared_ptr<const ExactMesh> mesh;
  std::shared_ptr<const ExactProfile> profile;
  /// Weights of the coordinates. By the measure Σ weight·x², the solid lies around its middle
  /// roughly like a ball.
  csgcore::Vec3 weight;
};

/// Makes the target of a primitive. World lengths are multiplied by `unit`, a power of two; if they
/// are about 1 then, no interval overflows.
Target<Exact> make_target(const csgcore::Primitive& primitive, const csgcore::Vec3& pivot,
                          double unit);
Target<Interval> enclose(const Target<Exact>& target);

/// A surface of a primitive: the wall, or the plane or the triangle with that index. The rims and
/// pointed ends of a frustum belong to its caps. The edges and vertices of a polyhedron belong to
/// the face with the lowest index.
enum class Surface : uint32_t { kBottom = 0, kTop = 1, kWall = 0xFFFFFFFFu };

/// The surfaces at the ends of a part of a ray within the closed primitive, which has a length > 0.
struct Ends {
  Surface begin, end;
  /// The part ends so much later in t than the ray meets `end`: at the back of an open mesh's
  /// sheet.
  double beyond = 0;
};

/// A ray in a target's local space, magnified by λ.
template <class Number>
struct LocalRay {
  Vector<Number> o, d;
  Walls<Number> walls;

  const Quadratic<Number>& wall(bool enters) const { return enters ? walls.enter : walls.leave; }
};

/// Maps a ray into the target's local space. `base` is the ray's parameter that becomes t = 0; a
/// good one keeps intervals narrow.
template <class Number>
LocalRay<Number> localize(const Target<Number>& target, const NearRay<Number>& ray, double base);

/// Returns approximately the parameter at which the ray passes the primitive.
double base_of(const Target<Interval>& target, const NearRay<Interval>& ray);

/// Returns the plane of a triangle that has an area.
template <class Number>
Plane<Number> triangle_plane(const ExactMesh& mesh, Surface triangle);
template <>
Plane<Exact> triangle_plane(const ExactMesh& mesh, Surface triangle);
template <>
Plane<Interval> triangle_plane(const ExactMesh& mesh, Surface triangle);

/// Returns visit(plane) for a surface that is a plane.
template <class Number, class Visit>
auto with_plane(const Target<Number>& target, Surface surface, const Visit& visit) {
  if (target.mesh) return visit(triangle_plane<Number>(*target.mesh, surface));
  return visit(target.planes[uint32_t(surface)]);
}

/// Returns the parameter at which the ray meets the surface, which must be that of an end, and not
/// of a profile's solid.
template <class Number>
auto crossing_of(const Target<Number>& target, const LocalRay<Number>& ray, Surface surface,
                 bool enters) {
  if (surface == Surface::kWall) return root_of(ray.wall(enters), enters);
  return with_plane(target, surface, [&](const Plane<Number>& plane) {
    return quotient(Number(plane.limit - dot(plane.normal, ray.o)), dot(plane.normal, ray.d));
  });
}

LocalRay<Interval> enclose(const LocalRay<Exact>& ray);

/// Returns an enclosure of the same parameter that is as tight as doubles allow. `enclosed` is
/// enclose(exact).
Interval enclose_crossing(const Target<Exact>& target, const LocalRay<Exact>& exact,
                          const LocalRay<Interval>& enclosed, Surface surface, bool enters);

/// Returns the ends of the ray's part within the target, if it has a length > 0. `planes` are the
/// indices, in ascending order, of all planes that may bound the part (see NearPlanes).
template <class Number>
std::optional<Ends> ends_of(const Target<Number>& target, const LocalRay<Number>& ray,
                            std::span<const uint32_t> planes);

/// Returns the primitive's outward normal in world space, of any length, for all parameters within
/// `t`. That of a mesh is its triangle's own, whichever side of it is inside; that of a profile's
/// solid may be inwards.
Vector<Interval> normal_at(const Target<Interval>& target, const LocalRay<Interval>& ray,
                           const Interval& t, Surface surface);

/// Returns |n·d| there, with the unit normal n and the ray's direction d in world space.
Interval steepness_at(const Target<Interval>& target, const LocalRay<Interval>& ray,
                      const Interval& t, Surface surface, bool enters);

inline Interval length(const Vector<Interval>& v) {
  return CGAL::sqrt(CGAL::square(v[0]) + CGAL::square(v[1]) + CGAL::square(v[2]));
}

}  // namespace oracle
