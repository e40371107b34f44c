// Intersects one primitive with one ray, and compares it with planes, in extended precision, for
// the reference.
#pragma once

#include <glm/mat3x3.hpp>
#include <memory>
#include <vector>

#include "csgcore/primitive.hpp"
#include "csgcore/view.hpp"
#include "kinds/local_solid.hpp"
#include "reference.hpp"

namespace csgcore::reference {

using LongMat3 = glm::mat<3, 3, Real>;

/// A valid primitive, prepared for rays whose positions are relative to `pivot`.
class RayTarget {
 public:
  RayTarget(const Primitive& primitive, const Vec3& pivot);
  /// Adds the spans of the ray; `thickness` is the tolerance.
  void add_spans(const NearRay& ray, Real thickness, std::vector<Span>& spans) const;
  /// The primitive's outward unit normal, in the world, at an end of a span.
  LongVec3 normal(const NearRay& ray, Real t, Surface surface) const;

 private:
  NearRay localize(const NearRay& ray) const;

  std::shared_ptr<const LocalSolid> solid_;
  LongMat3 world_to_local_;
  LongVec3 middle_to_pivot_;  // from the point that the local solid is relative to; in the world
};

/// Returns a + s·d − b, exact up to one rounding of the result, whatever cancels.
LongVec3 exact_offset(const Vec3& a, double s, const Vec3& d, const Vec3& b);

/// A half-space dot(x − point, normal) ≥ 0; `normal` of any length.
struct HalfSpace {
  Vec3 point, normal;
};

/// Returns the maximum over the primitive of dot(x − point, normal).
double furthest(const Primitive& primitive, const HalfSpace& half_space);

/// Returns false only if the primitive certainly has no point in the half-space, however it is
/// rounded.
bool reaches(const Primitive& primitive, const HalfSpace& half_space);

}  // namespace csgcore::reference
