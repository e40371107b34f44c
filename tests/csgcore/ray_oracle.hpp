// The judge of the packets' arithmetic: one primitive and one ray in extended precision, by search
// instead of formulas, and a bound of the error in double.
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

/// Makes a packet of kPacketRays rays.
RayPacket packet_of(std::span<const PivotRay> rays);

/// A primitive that rays are compared with.
class RayOracle {
 public:
  RayOracle(const Primitive& primitive, const Vec3& pivot);

  struct Segment {
    Real start = 0, end = 0;
    bool exists() const { return start < end; }
  };
  /// Of a convex primitive.
  Segment segment(const LongRay& ray) const;

  /// Fails if [start, end) is not the ray's segment, or (+∞, −∞) if it has none, up to
  /// `error_bound`. Returns the error in units of that bound.
  double expect_segment(const LongRay& ray, double start, double end) const;

  /// Returns how far a surface may seem displaced along its normal, in world units: kRoundings of a
  /// double of the coordinates from which it is computed. These are relative to the pivot, and, if
  /// a primitive's middle is not its origin, the world's. Taking them to the primitive's canonical
  /// space and back costs the condition of its map.
  Real error_bound(const LongRay& ray) const;

  /// Returns how far a point (relative to the pivot) is outside of the primitive, along the normal
  /// there; negative inside. It is exact at the surface, and of first order near it.
  Real gap(const LongVec3& point) const;
  /// Fails unless `normal` is the outward unit normal at the point of any side there, up to
  /// rounding and to the change of the normal within `reach`.
  void expect_normal(const LongVec3& point, const Vec3& normal, Real reach) const;

 private:
  /// A test_support::Side whose gradient is in the world.
  struct Side {
    Real outside;
    LongVec3 gradient;
    Real gap() const;
  };
  LongVec3 to_local(const LongVec3& point) const;
  std::vector<Side> sides(const LongVec3& point) const;
  Side nearest(const LongVec3& point) const;
  /// Negative inside the primitive, and convex along any line.
  Real outside(const LongRay& ray, Real t) const;
  Real lowest(const LongRay& ray, Real low, Real high) const;
  Real crossing(const LongRay& ray, Real inside, Real outside) const;
  Real deepest(const LongRay& ray, const Segment& segment) const;
  Real error_of_end(const LongRay& ray, Real computed, Real expected) const;

  Primitive primitive_;
  const test_support::TestKind& kind_;
  LongMat3 world_to_local_;
  LongVec3 middle_from_pivot_, pivot_from_local_origin_;
  Real size_;         // bound of the points' distances from the primitive's middle, in world units
  Real coordinates_;  // of its middle, if that has to be computed
  Real condition_;    // of its map, by rows: the largest row sum of |M|·|M⁻¹|, which is 1 for a
                      // diagonal map
};

/// About 20 roundings of half a unit each lead to a crossing: centre − pivot, origin − centre, the
/// inverse's own error, three products and two sums, base and foot, squares and a root. They are
/// unlikely to add up: the worst of all that the tests draw is 2 (NUMERICS.md).
constexpr double kRoundings = 4;

}  // namespace csgcore::checks
