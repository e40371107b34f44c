// Points of space on a grid of whole numbers, where predicates are exact.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/geometry.hpp"

namespace frontend {

/// Coordinates from 0 to 2^52, so that differences are exact in double, too.
struct GridPoint {
  int64_t x, y, z;
  auto operator<=>(const GridPoint&) const = default;
};

/// Points within a box, as multiples of 2^exponent from its least corner. A multiple is at most
/// 2^-51 of the box's longest side: the rounding of a point is far below what a picture or its
/// oracles tell apart.
struct PointGrid {
  csgcore::Vec3 origin{0.0};
  int exponent = 0;
  std::vector<GridPoint> points;  // in the given order
};

/// All coordinates must be finite.
PointGrid on_grid(std::span<const csgcore::Vec3> points);

/// Returns the normal (b − a) × (c − a), of which each component is rounded once.
csgcore::Vec3 normal_of(const GridPoint& a, const GridPoint& b, const GridPoint& c);

/// Returns 1 if d lies on the side of the plane a b c from which these are seen counterclockwise,
/// −1 on the other side, and 0 in the plane. It is exact.
int orientation(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d);

/// Returns whether the three points lie on a line. It is exact.
bool are_collinear(const GridPoint& a, const GridPoint& b, const GridPoint& c);

}  // namespace frontend
