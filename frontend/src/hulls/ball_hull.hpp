// The convex hull of balls and points.
#pragma once

#include <vector>

#include "csgcore/primitive.hpp"
#include "hulls/round_bodies.hpp"

namespace frontend {

/// Adds primitives whose union is the hull: the polyhedron of the points where planes touch three
/// balls from outside, the frusta that touch two balls, and balls. Each lies within the hull, up to
/// rounding, so that one too many does no harm. Nothing if all are points on a line; of points in a
/// plane a thin sheet. Where the arc at which a plane rolls around two balls is below
/// `least_strip` (radians), there is no frustum. Returns false, and adds some pieces only, if the
/// search for them takes too long (kMostStripSteps).
[[nodiscard]] bool add_ball_hull(std::vector<RoundBody> balls, double least_strip,
                                 std::vector<csgcore::Primitive>& pieces);

}  // namespace frontend
