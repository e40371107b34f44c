// Points that planes define: where an edge meets a plane, and where three planes meet.
#pragma once

#include "arrangement/grid.hpp"
#include "arrangement/wide.hpp"

namespace csgcore {

/// A rational point (x/w, y/w, z/w) in homogeneous coordinates, w > 0. |x| < 2^288, w < 2^247.
struct ExactPoint {
  std::array<Wide<5>, 3> x;
  Wide<4> w;
};

ExactPoint exact_point(const GridPoint& point);
/// Returns where the line through a and b meets the plane, which it does in one point.
ExactPoint meet(const GridPoint& a, const GridPoint& b, const GridPlane& plane);
/// Returns where the planes meet, which they do in one point.
ExactPoint meet(const GridPlane& p, const GridPlane& q, const GridPlane& r);

/// Returns the point, each coordinate off by less than kPointError.
Vec3 rounded(const ExactPoint& point);
/// Numerator, denominator and their quotient are rounded, by an ulp at most in all, of up to
/// 2^kGridBits; a unit of the grid is 1.
constexpr double kPointError = 0x1p-11;

/// Returns side() of the plane for the point, exactly.
int side(const GridPlane& plane, const ExactPoint& point);
/// Returns turn() of the points, exactly.
int turn(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, int axis);

}  // namespace csgcore
