// Points and planes of integer coordinates, and exact predicates on them. The widths of what the
// predicates compute are bounded in MESHES.md.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "arrangement/wide.hpp"
#include "csgcore/geometry.hpp"

namespace csgcore {

/// Coordinates are at most 2^kGridBits in magnitude, so that the volume of four points' simplex
/// fits into 128 bits.
constexpr int kGridBits = 39;

using GridPoint = std::array<int64_t, 3>;

inline Vec3 to_vec3(const GridPoint& point) {
  return {static_cast<double>(point[0]), static_cast<double>(point[1]),
          static_cast<double>(point[2])};
}

/// Returns the sign of a number: -1, 0 or 1.
inline int sign_of(Int128 value) { return (value > 0) - (value < 0); }
inline int sign_of(double value) { return (value > 0) - (value < 0); }

/// An oriented plane: points x with normal·(x − point) = 0.
struct GridPlane {
  std::array<Int128, 3> normal;  // at most 2^81 + 2^81 in magnitude
  GridPoint point;
  Vec3 rounded_normal;  // the normal in double

  /// Returns normal·(x − point), exactly.
  Int128 height(const GridPoint& x) const {
    return normal[0] * (x[0] - point[0]) + normal[1] * (x[1] - point[1]) +
           normal[2] * (x[2] - point[2]);
  }
  /// Returns normal·point, exactly.
  Int128 offset() const {
    return normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2];
  }
  /// Returns the axis along which the normal is longest: the plane projects well along it.
  int axis() const {
    const Vec3 n = glm::abs(rounded_normal);
    if (n.x >= n.y && n.x >= n.z) return 0;
    return n.y >= n.z ? 1 : 2;
  }
};

/// Returns the plane through the points, which may not be on a line; seen from where its normal
/// points to, they are counterclockwise.
GridPlane plane_through(const GridPoint& a, const GridPoint& b, const GridPoint& c);
/// Returns the plane through the line from a to b that is parallel to an axis: its normal points
/// to the right of the line where (u, v) of the axis are the coordinates of a drawing.
GridPlane plane_along(const GridPoint& a, const GridPoint& b, int axis);

/// Returns 1 for a point on the side that the normal points to, -1 on the other side, 0 on it.
inline int side(const GridPlane& plane, const GridPoint& x) {
  const Vec3 terms = plane.rounded_normal * (to_vec3(x) - to_vec3(plane.point));
  const double height = terms.x + terms.y + terms.z;
  // The normal, each product and two sums are rounded: five roundings of at most half an ulp.
  constexpr double kRounding = 6 * 0x1p-53;
  const double bound = kRounding * (std::abs(terms.x) + std::abs(terms.y) + std::abs(terms.z));
  if (std::abs(height) > bound) return sign_of(height);
  return sign_of(plane.height(x));
}

/// The coordinates of a drawing along an axis, right-handed if one looks against the axis.
constexpr int kNextAxis[] = {1, 2, 0, 1};
inline int u_axis(int axis) { return kNextAxis[axis]; }
inline int v_axis(int axis) { return kNextAxis[axis + 1]; }

/// Returns whether the way from a over b to c turns left (1) or right (-1) in the drawing along
/// the axis, or runs straight (0).
inline int turn(const GridPoint& a, const GridPoint& b, const GridPoint& c, int axis) {
  const auto u = static_cast<size_t>(u_axis(axis));
  const auto v = static_cast<size_t>(v_axis(axis));
  return sign_of(Int128{b[u] - a[u]} * (c[v] - a[v]) - Int128{b[v] - a[v]} * (c[u] - a[u]));
}

/// Returns the sign of (b − a)·((c − a) × (d − a)).
inline int orientation(const GridPoint& a, const GridPoint& b, const GridPoint& c,
                       const GridPoint& d) {
  return side(plane_through(a, c, d), b);
}

}  // namespace csgcore
