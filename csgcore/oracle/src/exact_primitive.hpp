// One primitive against one ray, in exact arithmetic or in intervals: the same formulas in both.
//
// A ray x(t) = origin + t·direction, relative to a pivot near the model, becomes in the primitive's
// local space, about its middle and magnified by λ > 0 (a power of two times |det M| of the
// local→world matrix M, so that no quotients are needed), o + t·d. There
//   sphere:  |o + t·d|² ≤ (λr)²
//   frustum: |z| ≤ λk, (2k)²(x² + y²) ≤ ρ(z)², ρ(z) = λk(r₀ + r₁) + (r₁ − r₀)z
//   polyhedron: n·(o + t·d) ≤ λ(offset − n·middle) for all its half-spaces
// with half its height k, its radii r₀ below and r₁ above; ρ(z) is 2kλ times the radius, and not
// negative within the slab. The wall's inequality is scaled by a power of four, a half-space's by a
// power of two.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "csgcore/primitive.hpp"
#include "exact_number.hpp"

namespace oracle {

template <class Number>
using Vector = std::array<Number, 3>;

template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Relative to a pivot, in world space and its prepared unit.
template <class Number>
struct NearRay {
  Vector<Number> origin, direction;
};

/// normal·x ≤ limit within.
template <class Number>
struct Plane {
  Vector<Number> normal;  // its largest coordinate is between 1 and 2
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

/// A valid primitive, prepared for rays that are relative to a pivot: what lies within its wall, if
/// it has one, and within all its planes. What has both has the planes of a slab across the z axis
/// for its first two.
template <class Number>
struct Target {
  const ExactTwin* twin = nullptr;
  bool has_wall = false;
  std::array<Vector<Number>, 3> to_local;  // rows of λM⁻¹
  Vector<Number> from_middle;         // from the local solid's middle to the pivot, in the world
  Number radius;                      // of the wall: λr, or λk(r₀ + r₁)
  Number growth, squared_height;      // r₁ − r₀, (2k)²; of a frustum's
  std::vector<Plane<Number>> planes;  // of a frustum the bottom and the top; a polyhedron's faces
  /// The solid lies about its middle as far as a ball, by this measure: Σ weight·x².
  csgcore::Vec3 weight;
};

/// `unit` is a power of two, by which lengths in the world are multiplied; if they are about 1
/// thereafter, no interval overflows.
Target<Exact> make_target(const csgcore::Primitive& primitive, const csgcore::Vec3& pivot,
                          double unit);
Target<Interval> enclose(const Target<Exact>& target);

/// Surfaces of a primitive: the wall, or the plane of that index. A point of a frustum's rim, or a
/// pointed end, belongs to the cap; one of a polyhedron's edge or vertex to the face of the lowest
/// index.
enum class Surface : uint32_t { kBottom = 0, kTop = 1, kWall = 0xFFFFFFFFu };

/// The part of a ray within the closed primitive, if it has any length.
struct Ends {
  Surface begin, end;
};

/// A ray in a target's local space, magnified by λ.
template <class Number>
struct LocalRay {
  Vector<Number> o, d;
  Walls<Number> walls;

  const Quadratic<Number>& wall(bool enters) const { return enters ? walls.enter : walls.leave; }
};

/// `base` is the ray's parameter that becomes t = 0, so that intervals stay narrow.
template <class Number>
LocalRay<Number> localize(const Target<Number>& target, const NearRay<Number>& ray, double base);

/// The parameter near which the ray passes the primitive, roughly.
double base_of(const Target<Interval>& target, const NearRay<Interval>& ray);

/// Where the ray meets the surface, which is that of an end.
template <class Number>
auto crossing_of(const Target<Number>& target, const LocalRay<Number>& ray, Surface surface,
                 bool enters) {
  if (surface == Surface::kWall) return root_of(ray.wall(enters), enters);
  const Plane<Number>& plane = target.planes[uint32_t(surface)];
  return quotient(Number(plane.limit - dot(plane.normal, ray.o)), dot(plane.normal, ray.d));
}

LocalRay<Interval> enclose(const LocalRay<Exact>& ray);

/// The same, as tight as doubles are, relative to the parameter. `enclosed` is enclose(exact).
Interval enclose_crossing(const Target<Exact>& target, const LocalRay<Exact>& exact,
                          const LocalRay<Interval>& enclosed, Surface surface, bool enters);

/// `planes` are indices in rising order, of all planes that may bound the part (see NearPlanes).
template <class Number>
std::optional<Ends> ends_of(const Target<Number>& target, const LocalRay<Number>& ray,
                            std::span<const uint32_t> planes);

/// The primitive's outward normal in world space, of any length, where t is within `t`.
Vector<Interval> normal_at(const Target<Interval>& target, const LocalRay<Interval>& ray,
                           const Interval& t, Surface surface);

/// |n·d| there, of the unit normal n and the ray's direction d in the world.
Interval steepness_at(const Target<Interval>& target, const LocalRay<Interval>& ray,
                      const Interval& t, Surface surface, bool enters);

inline Interval length(const Vector<Interval>& v) {
  return CGAL::sqrt(CGAL::square(v[0]) + CGAL::square(v[1]) + CGAL::square(v[2]));
}

}  // namespace oracle
