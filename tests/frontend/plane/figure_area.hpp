// Measures plane figures for tests.
#pragma once

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "plane/figure.hpp"
#include "plane/outlines.hpp"

namespace frontend {

constexpr double kPi = std::numbers::pi;

/// Returns the area that the polygons enclose, holes being clockwise.
inline double area_of(std::span<const Polygon> polygons) {
  double area = 0;
  for (const Polygon& polygon : polygons) {
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Vec2& a = polygon[i];
      const Vec2& b = polygon[(i + 1) % polygon.size()];
      area += cross(a, b) / 2;
    }
  }
  return area;
}

/// Returns the area between the figure's loops, with chords in place of curves.
inline double area_of(const Figure& figure) { return area_of(chords_of(figure)); }

inline double area_of_union(const std::vector<Figure>& figures) {
  return area_of(united(figures).value());
}

/// A share of the area of a disc that its chords leave out, rounded up.
constexpr double kChordsShare = 6e-5;

inline Figure rectangle(double x_min, double y_min, double x_max, double y_max) {
  return outline_of(Polygons{{{x_min, y_min}, {x_max, y_min}, {x_max, y_max}, {x_min, y_max}}});
}

}  // namespace frontend
