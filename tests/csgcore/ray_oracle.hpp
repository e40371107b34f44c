// What the packets' arithmetic is held against: one primitive and one ray in extended precision, by
// search instead of formulas, and how far a double may be off.
#pragma once

#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "csgcore/primitive.hpp"
#include "packets/packet.hpp"
#include "support/kinds/test_kind.hpp"

namespace csgcore::checks {

using Real = csgcore::Real;
using LongVec3 = csgcore::LongVec3;
using LongMat3 = glm::mat<3, 3, Real>;

/// origin + t·direction, relative to a pivot.
struct LongRay {
  LongVec3 origin, direction;
  LongVec3 at(Real t) const { return origin + t * direction; }
};
struct PivotRay {
  Vec3 origin, direction;
  operator LongRay() const { return {LongVec3(origin), LongVec3(direction)}; }
};

/// kPacketRays of them as a packet.
RayPacket packet_of(std::span<const PivotRay> rays);

/// A primitive among rays.
class RayOracle {
 public:
  RayOracle(const Primitive& primitive, const Vec3& pivot);

  struct Segment {
    Real start = 0, end = 0;
    bool exists() const { return start < end; }
  };
  Segment segment(const LongRay& ray) const;

  /// Fails if start < end is not the ray's segment, or +∞ and −∞ where there is none, up to
  /// `error_bound`. Returns by how much it is off, in units of that bound.
  double expect_segment(const LongRay& ray, double start, double end) const;

  /// How far a surface may seem displaced along its normal, in world units: kRoundings of a double,
  /// of the coordinates that it is computed from: relative to the pivot and, of a primitive whose
  /// middle is not its origin, the world's. They are taken to the primitive's canonical space and
  /// back, which costs the condition of its map.
  Real error_bound(const LongRay& ray) const;

  /// How far a point (relative to the pivot) lies outside of the primitive, along the normal there;
  /// inside of it negative. Exact at the surface, and of the first order next to it.
  Real gap(const LongVec3& point) const;
  /// Fails unless a vector is the outward unit normal at the point, of any side that is there, up
  /// to how much the normal changes within `reach` of it, and rounding.
  void expect_normal(const LongVec3& point, const Vec3& normal, Real reach) const;

 private:
  /// As test_support::Side, its gradient in the world.
  struct Side {
    Real outside;
    LongVec3 gradient;
    Real gap() const;
  };
  LongVec3 to_local(const LongVec3& point) const;
  std::vector<Side> sides(const LongVec3& point) const;
  Side nearest(const LongVec3& point) const;
  /// Negative within the primitive, and convex along any line.
  Real outside(const LongRay& ray, Real t) const;
  Real lowest(const LongRay& ray, Real low, Real high) const;
  Real crossing(const LongRay& ray, Real inside, Real outside) const;
  Real deepest(const LongRay& ray, const Segment& segment) const;
  Real error_of_end(const LongRay& ray, Real computed, Real expected) const;

  Primitive primitive_;
  const test_support::TestKind& kind_;
  LongMat3 world_to_local_;
  LongVec3 middle_from_pivot_, pivot_from_local_origin_;
  Real size_;         // world units: no point is further from the primitive's middle
  Real coordinates_;  // of its middle, if that must be computed
  Real condition_;  // of its map, by rows: largest row sum of |M|·|M⁻¹|, 1 for any diagonal one
};

/// Some 20 roundings, of half a unit each, lead to a crossing: centre − pivot, origin − centre, the
/// inverse's own error, three products and two sums, base and foot, squares and a root. That they
/// all add up is unlikely: of all that the tests draw the worst are 2 (NUMERICS.md).
constexpr double kRoundings = 4;

}  // namespace csgcore::checks
