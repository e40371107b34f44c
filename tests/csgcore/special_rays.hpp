// Makes rays that are hard on a primitive.
#pragma once

#include <random>
#include <vector>

#include "csgcore/primitive.hpp"
#include "ray_oracle.hpp"
#include "support/kinds/test_kind.hpp"

namespace csgcore::checks {

enum class RayKind : uint8_t {
  kAny,
  kTangent,
  kAlongAxis,
  kInCapPlane,
  kThroughRim,
  kAlongGeneratrix,
  kThroughApex,
  kLevelButForATrace,
  kUprightButForATrace,
};
constexpr int kRayKinds = 9;
const char* name_of(RayKind kind);

/// Makes rays at a primitive, relative to a pivot. Their special property (tangent, in a cap's
/// plane, along a generatrix, …) holds in the primitive's local space. In the world it holds up to
/// the rounding of the primitive's map: exactly under a map of small integers.
class SpecialRays {
 public:
  SpecialRays(const Primitive& primitive, const Vec3& pivot, std::mt19937& random);

  /// Returns kPacketRays rays.
  std::vector<PivotRay> next(RayKind kind);

 private:
  PivotRay make(RayKind kind);
  PivotRay any();
  PivotRay tangent();
  PivotRay along_axis();
  PivotRay in_cap_plane();
  PivotRay through_rim();
  PivotRay along_generatrix();
  PivotRay through_apex();
  PivotRay level_but_for_a_trace();
  PivotRay upright_but_for_a_trace();

  double pick(double low, double high);
  bool chance(double probability) { return pick(0, 1) < probability; }
  Vec3 any_direction();
  /// Returns a unit vector in the local x-y plane, often an axis.
  Vec3 sideways();
  /// Returns the surface point on the side of `sideways`; if its length is not 1, a point at that
  /// share of the way from the axis.
  Vec3 on_surface(const Vec3& sideways, double height) const {
    return kind_.on_surface(primitive_, sideways, height);
  }
  /// Returns the vector from the lowest point on that side to the highest.
  Vec3 generatrix(const Vec3& sideways) const {
    return on_surface(sideways, z_max_) - on_surface(sideways, z_min_);
  }
  double any_height() {
    return chance(0.3) ? (chance(0.5) ? z_min_ : z_max_) : pick(z_min_, z_max_);
  }
  /// Returns a number so small that its square is 0 in double, or its inverse infinite; or about a
  /// rounding.
  double trace();
  /// Returns 0, or a few roundings to a millionth of the size, to either side.
  double near_miss();
  /// Returns a ray through a local point, with its origin anywhere on the line and a direction of
  /// any length.
  PivotRay through(const Vec3& point_local, const Vec3& direction_local);

  const Primitive primitive_;
  const Affine map_;
  const Vec3 pivot_;
  std::mt19937& random_;
  const test_support::TestKind& kind_;
  const double z_min_, z_max_;
  const double size_;  // local
};

}  // namespace csgcore::checks
