// Points that count as moved: by far the most along x, and more along y than along z, each by less
// than any distance (simulation of simplicity), so that they are on no plane and no line.
#pragma once

#include <array>

#include "arrangement/planar_subdivision.hpp"

namespace csgcore {

/// A rational point in homogeneous coordinates, w > 0.
struct ExactCenter {
  std::array<Wide<14>, 3> x;
  Wide<13> w;
};

/// A point of the grid, moved.
class MovedPoint {
 public:
  explicit MovedPoint(const GridPoint& point) : point_(point) {}

  Vec3 position() const { return to_vec3(point_); }
  /// The turn (grid.hpp) of two points and this one; never 0.
  int turn(const GridPoint& a, const GridPoint& b, int axis) const;
  /// The side of the plane on which the point lies; never 0.
  int side(const GridPlane& plane) const;

 private:
  GridPoint point_;
};

/// The centre of a triangle, moved.
class MovedCenter {
 public:
  /// Keeps references to the facets and the points.
  MovedCenter(const Facets& facets, const std::array<const ArrangedPoint*, 3>& triangle);

  /// Off by less than 2·kPointError.
  const Vec3& position() const { return position_; }
  int turn(const GridPoint& a, const GridPoint& b, int axis) const;
  int side(const GridPlane& plane) const;

 private:
  const ExactCenter& exact() const;

  const Facets& facets_;
  std::array<const ArrangedPoint*, 3> triangle_;
  Vec3 position_;
  mutable bool has_exact_ = false;
  mutable ExactCenter exact_;
};

}  // namespace csgcore
