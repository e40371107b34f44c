// The camera as a geometric object: which rays belong to which pixel.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "csgcore/geometry.hpp"

namespace csgcore {

enum class Projection : uint8_t { kPerspective, kOrthographic };

/// A camera in world space. `right`, `up` and `forward` are orthonormal with right × up = −forward,
/// or = forward if the picture is mirrored. half_height > 0, and the picture has at least one
/// pixel.
/// A pixel (x, y), y downwards from the top left corner, is seen along the ray through its centre:
///   u = (2(x + ½) − width)/height · half_height,  v = (height − 2(y + ½))/height · half_height
///   perspective:  p(s) = eye + s·(forward + u·right + v·up), s > 0, half_height = tan(fov/2)
///   orthographic: p(s) = eye + u·right + v·up + s·forward, any s, half_height in world units
/// In both, s is the Z channel: the distance from the eye's plane along the view axis.
/// As in OpenSCAD nothing is clipped at a near or far plane; an orthographic picture also shows
/// what lies behind the eye.
struct View {
  Projection projection = Projection::kPerspective;
  Vec3 eye{0.0};
  Vec3 right{1, 0, 0};
  Vec3 up{0, 1, 0};
  Vec3 forward{0, 0, -1};
  double half_height = 1;
  uint32_t width_px = 512;
  uint32_t height_px = 512;
  bool operator==(const View&) const = default;
};

/// A rectangle of a picture's pixels: x to the right, y downwards from the top left corner.
struct PixelArea {
  uint32_t x = 0, y = 0, width = 0, height = 0;
  bool empty() const { return width == 0 || height == 0; }
  bool operator==(const PixelArea&) const = default;
};

/// Returns the pixels of both areas.
PixelArea intersection(const PixelArea& a, const PixelArea& b);

/// The points origin + s·direction, in world space.
struct Ray {
  Vec3 origin;
  Vec3 direction;
};

/// Returns the ray through (x_px + ½, y_px + ½), which is the centre of a pixel if both are whole
/// numbers. Its parameter is View's s.
Ray pixel_ray(const View& view, double x_px, double y_px);

/// Returns an upper bound of the size, in pixels, of the box's projection: the larger side of its
/// bounding rectangle on the screen. In a perspective view it is +inf if the box reaches the eye's
/// plane from in front, and 0 if the whole box lies behind that plane.
double projected_size_px(const View& view, const Box& box);

/// Returns whether projected_size_px(view, box) < size_px, up to rounding. It is faster, since most
/// boxes are decided by one of their diagonals.
bool projects_below(const View& view, const Box& box, double size_px);

/// Returns the offset of sample i of n, 0 ≤ i < n, from the pixel's centre, in pixels (x to the
/// right, y downwards), each in (−½, ½). A single sample lies at the centre.
///
/// There is one pattern for all pixels and all renderers, so that pictures are deterministic and
/// comparable: a Fibonacci lattice. It is evenly spaced in x, so that an upright edge is seen in
/// n steps of equal size. In y it takes multiples of the golden ratio modulo 1, which are all
/// different and whose gaps have at most three sizes (Niederreiter, Random Number Generation and
/// Quasi-Monte Carlo Methods, 1992, chapter 5). A half-turn about the centre maps the pattern onto
/// itself, so that on average no edge is shifted.
inline std::array<double, 2> sample_offset(uint32_t i, uint32_t n) {
  // Counting from the middle sample makes the half-turn's symmetry exact to the bit.
  const double from_middle = i - 0.5 * (n - 1.0);
  const double y = from_middle * (std::numbers::phi - 1);  // 1/φ
  return {from_middle / n, y - std::round(y)};
}

}  // namespace csgcore
