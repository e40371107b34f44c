// Affine maps of the plane.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>

#include "csgcore/geometry.hpp"
#include "csgcore/profile.hpp"

namespace frontend {

using csgcore::Vec2;

/// Returns the point seen along z.
inline Vec2 plan_of(const csgcore::Vec3& point) { return {point.x, point.y}; }

/// Returns the vector turned counterclockwise by an angle in radians.
inline Vec2 turned(const Vec2& v, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// The affine map x ↦ linear·x + translation.
struct PlaneMap {
  glm::dmat2 linear{1.0};
  Vec2 translation{0.0};

  Vec2 point(const Vec2& p) const { return linear * p + translation; }
  double determinant() const { return linear[0].x * linear[1].y - linear[1].x * linear[0].y; }
};

/// Returns the map a ∘ b, which applies b first.
inline PlaneMap compose(const PlaneMap& a, const PlaneMap& b) {
  return {a.linear * b.linear, a.point(b.translation)};
}

/// Returns whether the map takes circles to circles, up to rounding.
inline bool keeps_circles(const PlaneMap& map) {
  constexpr double kRounding = 1e-9;  // a share of a radius that no picture shows
  const double a = glm::length(map.linear[0]);
  const double b = glm::length(map.linear[1]);
  return std::abs(a - b) <= kRounding * a &&
         std::abs(glm::dot(map.linear[0], map.linear[1])) <= kRounding * a * a;
}

/// Returns what OpenSCAD takes of a matrix that acts on a plane figure: its rows and columns x, y
/// and the translation.
inline PlaneMap plane_part(const csgcore::Affine& map) {
  return {glm::dmat2(map.linear[0].x, map.linear[0].y, map.linear[1].x, map.linear[1].y),
          Vec2(map.translation.x, map.translation.y)};
}

/// Returns the map of space that acts like this one on x and y, and leaves z.
inline csgcore::Affine in_space(const PlaneMap& map) {
  csgcore::Affine result;
  for (int column = 0; column < 2; ++column) {
    result.linear[column] = csgcore::Vec3(map.linear[column].x, map.linear[column].y, 0);
  }
  result.translation = csgcore::Vec3(map.translation.x, map.translation.y, 0);
  return result;
}

}  // namespace frontend
