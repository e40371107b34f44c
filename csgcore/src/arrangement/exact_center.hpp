// The middle of a piece of a face, and the ways that lead to it along the axes.
#pragma once

#include <array>

#include "arrangement/planar_subdivision.hpp"

namespace csgcore {

/// A rational point in homogeneous coordinates, w > 0.
struct ExactCenter {
  std::array<Wide<14>, 3> x;
  Wide<13> w;
};

/// A point on the way to the centre of a triangle: along each axis it stands where the way starts,
/// or where the centre is.
class WayPoint {
 public:
  /// Keeps references to the points.
  WayPoint(const std::array<const ArrangedPoint*, 3>& triangle, const GridPoint& start);

  /// Moves along the axis, from the start to the centre.
  void move(int axis);

  const Vec3& position() const { return position_; }
  /// The turn (grid.hpp) of two points and this one; never 0, since the point counts as moved, by
  /// far the most along x, and more along y than along z.
  int turn(const GridPoint& a, const GridPoint& b, int axis) const;
  /// The side of the plane on which the point lies, moved likewise.
  int side(const GridPlane& plane) const;

 private:
  const ExactCenter& exact() const;

  std::array<const ArrangedPoint*, 3> triangle_;
  GridPoint start_;
  Vec3 center_;
  Vec3 position_;
  std::array<bool, 3> is_at_center_{};
  mutable bool has_center_ = false;
  mutable bool has_exact_ = false;
  mutable ExactCenter exact_center_;
  mutable ExactCenter exact_;
};

/// The sign of (n·δ) for δ that is by far the longest along x, and longer along y than along z.
int side_of_moved(const GridPlane& plane);
/// The turn of two points and one on their line that is moved likewise.
int turn_of_moved(const GridPoint& a, const GridPoint& b, int axis);

}  // namespace csgcore
