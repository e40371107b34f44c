// Boxes of points, discs and balls under affine maps, enclosed by intervals. RoundingUp must be on.
#pragma once

#include <algorithm>

#include "csgcore/geometry.hpp"
#include "exact_number.hpp"

namespace oracle {

/// Returns one coordinate of a local point's image relative to a world point, accurate however far
/// both are from the origin.
inline Interval coordinate_about(const csgcore::Vec3& point, const csgcore::Affine& map,
                                 const csgcore::Vec3& local, int axis) {
  Exact sum = Exact(map.translation[axis]) - Exact(point[axis]);
  for (int i = 0; i < 3; ++i) sum += Exact(map.linear[i][axis]) * Exact(local[i]);
  return enclose(sum);
}

inline void merge(const Interval& coordinate, int axis, csgcore::Box& box) {
  box.min[axis] = std::min(box.min[axis], coordinate.inf());
  box.max[axis] = std::max(box.max[axis], coordinate.sup());
}

inline void merge_point(const csgcore::Vec3& point, const csgcore::Affine& map,
                        const csgcore::Vec3& local, csgcore::Box& box) {
  for (int i = 0; i < 3; ++i) merge(coordinate_about(point, map, local, i), i, box);
}

/// Extends the box by the image of a disc across the local z axis (columns = 2) or of a ball
/// (columns = 3), whose centre is on that axis at height z. Along a world axis the image reaches as
/// far as the radius times the norm of that coordinate of the map's first columns.
inline void merge_round(const csgcore::Vec3& point, const csgcore::Affine& map, double z,
                        double radius, int columns, csgcore::Box& box) {
  for (int i = 0; i < 3; ++i) {
    Interval reach2 = 0;
    for (int k = 0; k < columns; ++k) reach2 += CGAL::square(Interval(map.linear[k][i]));
    const Interval reach = CGAL::sqrt(reach2) * Interval(radius);
    merge(coordinate_about(point, map, {0, 0, z}, i) + Interval(-1, 1) * reach, i, box);
  }
}

/// Extends the box by the image of the disc across the local z axis at height z.
inline void merge_disc(const csgcore::Vec3& point, const csgcore::Affine& map, double z,
                       double radius, csgcore::Box& box) {
  merge_round(point, map, z, radius, 2, box);
}

/// Extends the box by the image of the ball about the local origin.
inline void merge_ball(const csgcore::Vec3& point, const csgcore::Affine& map, double radius,
                       csgcore::Box& box) {
  merge_round(point, map, 0, radius, 3, box);
}

}  // namespace oracle
