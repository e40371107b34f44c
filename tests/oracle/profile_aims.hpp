// Rays that are hard on extruded and revolved profiles.
#pragma once

#include <random>

#include "csgcore/primitive.hpp"
#include "csgcore/profile.hpp"
#include "ray_oracle.hpp"

namespace oracle {

/// What a ray is aimed at, in the primitive's local space.
enum class Aim : uint8_t {
  kAny,
  kAtAVertex,
  kTangent,  // along the profile's edge, around the axis, or between
  kGrazing,  // the same, but for some roundings to a thousandth of the size
  kAlongAxis,
  kThroughAxis,
  kLevel,
  kToAnotherPoint,
  kFromFarAway,
};
constexpr int kAims = 9;
const char* name_of(Aim aim);

/// Aims rays at a primitive. All of them pass its surface, up to rounding; many are level, along
/// the axis or tangent up to a trace.
class AimedRays {
 public:
  /// The primitive and the generator must outlive this object.
  AimedRays(const csgcore::Primitive& primitive, const csgcore::Vec3& pivot, std::mt19937& random);

  /// Returns a ray relative to the pivot, with its origin anywhere and a direction of any length.
  csgcore::checks::PivotRay next(Aim aim);

 private:
  /// A point of the surface, two directions along the surface there, and its normal.
  struct Place {
    csgcore::Vec3 point, up, around, normal;
  };
  Place revolved(const csgcore::Vec2& at, const csgcore::Vec2& tangent);
  Place extruded(const csgcore::Vec2& at, const csgcore::Vec2& tangent);
  Place next_place(bool is_vertex);
  csgcore::Vec3 touching(const Place& place);
  csgcore::Vec3 nearly_upright();
  csgcore::Vec3 nearly_level(const Place& place);
  double power(double low, double high);
  double near_miss();

  const csgcore::Primitive& primitive_;
  const csgcore::Vec3 pivot_;
  std::mt19937& random_;
  const double size_;  // of the figure
};

}  // namespace oracle
