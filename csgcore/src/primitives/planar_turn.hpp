// Triangles in a plane as seen from its origin: whether they wind around it, exactly, and at which
// depth.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace csgcore {

struct PlanarPoint {
  double x, y;
};

/// Returns the sign of a × b where the rounded products are equal.
inline int turn_of_equal_products(PlanarPoint a, PlanarPoint b) {
  // The remainders of products this small would not be representable. Powers of two are exact.
  constexpr double kSmallProduct = 0x1p-900, kMagnified = 0x1p600;
  if (std::abs(a.x * b.y) < kSmallProduct) {
    a = {a.x * kMagnified, a.y * kMagnified};
    b = {b.x * kMagnified, b.y * kMagnified};
  }
  const double left = a.x * b.y, right = a.y * b.x;
  if (left != right) return left < right ? -1 : 1;
  const double left_rest = std::fma(a.x, b.y, -left), right_rest = std::fma(a.y, b.x, -right);
  if (left_rest != right_rest) return left_rest < right_rest ? -1 : 1;
  // The origin lies on the line through both points. It is moved to (ε, ε²) for an ε that is less
  // than any number: simulation of simplicity (Edelsbrunner and Mücke 1990).
  if (a.y != b.y) return a.y < b.y ? -1 : 1;
  if (a.x != b.x) return a.x < b.x ? 1 : -1;
  return 0;
}

/// Returns on which side of the line from a to b the origin lies: 1 on the left, −1 on the right,
/// and 0 only if the two are the same point. It is exact for doubles up to 1e150. The sign is that
/// of a point next to the origin, the same for all lines, that lies on no line through other
/// points.
inline int planar_turn(PlanarPoint a, PlanarPoint b) {
  // Rounding keeps the order of products unless it makes them equal.
  const double left = a.x * b.y, right = a.y * b.x;
  if (left != right) return left < right ? -1 : 1;
  return turn_of_equal_products(a, b);
}

/// Returns how often the triangle winds around the origin, or around the point next to it: 1, −1,
/// or 0 if that lies outside.
inline int winding_of(PlanarPoint a, PlanarPoint b, PlanarPoint c) {
  const int first = planar_turn(a, b);
  return first == planar_turn(b, c) && first == planar_turn(c, a) ? first : 0;
}

/// Depths between which a triangle is passed.
struct DepthRange {
  double nearest, furthest;
};

/// Returns the depths between which a triangle is passed at the origin, around which it winds:
/// those of the two edges that pass the origin on either side, across the longer extent. Of a
/// triangle that is seen edge-on they tell more than its plane.
inline DepthRange depth_range(const PlanarPoint (&corners)[3], const double (&depths)[3]) {
  const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [low, high] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  const bool is_wide = right - left >= high - low;
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  DepthRange range{kEndless, -kEndless};
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const double from = is_wide ? corners[k].x : corners[k].y;
    const double to = is_wide ? corners[next].x : corners[next].y;
    // The origin counts as beyond a corner that is level with it (turn_of_equal_products).
    if ((from <= 0) == (to <= 0)) continue;
    const double depth = depths[k] + from / (from - to) * (depths[next] - depths[k]);
    range.nearest = std::min(range.nearest, depth);
    range.furthest = std::max(range.furthest, depth);
  }
  return range;
}

}  // namespace csgcore
