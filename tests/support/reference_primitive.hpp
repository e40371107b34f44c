// One primitive against one ray and against planes, for the reference: in extended precision.
#pragma once

#include <glm/mat3x3.hpp>
#include <span>

#include "csgcore/primitive.hpp"
#include "csgcore/view.hpp"
#include "reference.hpp"

namespace csgcore::reference {

using LongMat3 = glm::mat<3, 3, Real>;

/// A ray near the model, however far from it the eye, or the world's origin, may be: positions are
/// relative to a point near the model, and t = 0 is where the ray is nearest to it, or about there.
struct NearRay {
  LongVec3 origin, direction;
};

/// Of a polyhedron, the half-space of that index.
enum class Surface : uint32_t { kBottom = 0, kTop = 1, kSide = 0xFFFFFFFFu };

/// The part of a ray inside a primitive. Empty unless begin < end.
struct Span {
  Real begin = 0, end = 0;
  Surface begin_surface = Surface::kSide, end_surface = Surface::kSide;
  bool empty() const { return !(begin < end); }
};

/// A valid primitive, prepared for rays whose positions are relative to `pivot`.
class RayTarget {
 public:
  RayTarget(const Primitive& primitive, const Vec3& pivot);
  Span span(const NearRay& ray) const;
  /// The primitive's outward unit normal, in the world, at an end of its span.
  LongVec3 normal(const NearRay& ray, Real t, Surface surface) const;

 private:
  NearRay localize(const NearRay& ray) const;
  Span cross_sphere(const NearRay& local) const;
  Span cross_frustum(const NearRay& local) const;
  Span cross_polyhedron(const NearRay& local) const;
  Real radius_at(Real z) const;

  Shape shape_;
  std::shared_ptr<const Polyhedron> polyhedron_;
  LongMat3 world_to_local_;
  LongVec3 middle_to_pivot_;  // from the local solid's middle (a polyhedron's origin), in the world
  Real r_bottom_, r_top_;
  Real half_height_ = 0;  // of the frustum; local z is measured from its middle
  Real slope_ = 0;
};

/// a + s·d − b, exact up to one rounding of the result, whatever cancels.
LongVec3 exact_offset(const Vec3& a, double s, const Vec3& d, const Vec3& b);

/// A half-space dot(x − point, normal) ≥ 0; `normal` of any length.
struct HalfSpace {
  Vec3 point, normal;
};

/// max over the primitive of dot(x − point, normal).
double furthest(const Primitive& primitive, const HalfSpace& half_space);

/// False only if the primitive has no point in the half-space, in spite of all rounding.
bool reaches(const Primitive& primitive, const HalfSpace& half_space);

}  // namespace csgcore::reference
