#include "csgcore/extent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "primitives/canonical_slack.hpp"

namespace csgcore {

/// The bounds of a primitive are computed with a few roundings of its coordinates, which this share
/// of the coordinates and the slack of the primitive's size cover.
constexpr double kBoxRounding = 8 * std::numeric_limits<double>::epsilon();

Extent extent_of(const CanonicalPrimitive& primitive) {
  Extent extent;
  const Box& bounds = primitive.bounds;
  for (int axis = 0; axis < 3; ++axis) {
    const double center = primitive.ball_radius > 0
                              ? primitive.center[axis]
                              : 0.5 * bounds.min[axis] + 0.5 * bounds.max[axis];
    const double half = std::max(bounds.max[axis] - center, center - bounds.min[axis]);
    extent.center[axis] = center;
    extent.half[axis] = half * (1.0 + kCanonicalSlack) + std::abs(center) * kBoxRounding;
  }
  const double radius2 = primitive.ball_radius * primitive.ball_radius;
  const bool is_ball = primitive.ball_radius > 0;
  extent.outside2 =
      is_ball ? radius2 * (1.0 + kCanonicalSlack) : std::numeric_limits<double>::infinity();
  extent.inside2 = is_ball ? radius2 * (1.0 - kCanonicalSlack) : -1.0;
  return extent;
}

}  // namespace csgcore
