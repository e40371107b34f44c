// The paths of rays through the half plane that holds a revolved profile, and their crossings with
// its pieces, in canonical coordinates: r is the distance from the axis, z the height.
//
// A ray passes the axis at a distance, its offset b. In the plane through it that runs along the
// axis, where a point has the places ρ and z with r² = b² + ρ², it is the straight line (ρ, z) =
// (start + τ·run, height + τ·rise). In the half plane it is a branch of a hyperbola, or, where it
// is level, a straight line that is passed towards the axis and back, and counts as a hyperbola
// that is thinner than any number.
//
// A vertex lies within this path, where r is larger, or else without; this is decided by the same
// operations for both pieces that share it. A piece whose ends lie on different sides is crossed an
// odd number of times, and another one an even number. So the crossings of a loop cancel.
#pragma once

#include <algorithm>

#include "csgcore/geometry.hpp"
#include "csgcore/profile.hpp"

namespace csgcore {

struct RevolutionPath {
  double offset;        // b ≥ 0
  double start;         // ρ at τ = 0
  double height;        // z at τ = 0
  double run, rise;     // run² + rise² = 1, run ≥ 0; rise is 0 if the ray is level
  bool starts_nearest;  // the ray is nearest to the axis at τ = 0; else it is not within the solid
  double first, last;   // τ where it enters and leaves the part that may hold the solid
  double base, unit;    // t = base + unit·τ

  /// 1 if the path runs upwards or is level, else −1.
  int upwards() const { return rise < 0 ? -1 : 1; }
};

/// A point of the half plane as a path sees it.
struct PathPoint {
  double r;
  double height;  // above the path's at τ = 0
  double run;     // rise·ρ, for the ray's point at this height
};

/// A height of 0 counts as one that is less than any other: simulation of simplicity.
constexpr double kNoHeight = 1e-200;

inline double height_above(double z, double path_height) {
  const double height = z - path_height;
  return height == 0 ? kNoHeight : height;
}

/// Returns the distance from the axis at a canonical place of the profile.
inline double radius_at(const Profile& profile, double x) {
  return std::max(0.0, profile.radii().x + profile.radii().y * x);
}

/// Returns the ray origin + t·direction, where the origin is the point next to the canonical origin
/// and inverse_length2 = 1/direction², as a path, but for its base, which is relative to that
/// point. Returns false if it misses the solid.
bool find_path(const Vec3& origin, const Vec3& direction, double inverse_length2,
               RevolutionPath& path);

}  // namespace csgcore
