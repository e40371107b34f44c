// The exact orientation of two points of a plane as seen from its origin.
#pragma once

#include <cmath>

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

}  // namespace csgcore
