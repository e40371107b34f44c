#include "thickness.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "csgcore/polyhedron.hpp"

namespace glrender {
namespace {

using csgcore::CanonicalPrimitive;
using csgcore::Mat3;
using csgcore::Polyhedron;
using csgcore::Shape;
using csgcore::Vec3;

/// Between the planes across that direction, of any length, that the primitive just lies between.
double width(const CanonicalPrimitive& primitive, const Vec3& direction) {
  const Vec3 across = glm::normalize(direction);
  return glm::dot(across, furthest_point(primitive, across) - furthest_point(primitive, -across));
}

/// The world's direction that canonical space stretches most: an ellipsoid's shortest axis.
Vec3 most_stretched(const Mat3& world_to_canonical) {
  // Powers of its square lead to it; ten squarings to the 1,024th.
  Mat3 power = glm::transpose(world_to_canonical) * world_to_canonical;
  for (int i = 0; i < 10; ++i) {
    double largest = 0;
    for (int k = 0; k < 3; ++k) largest = std::max(largest, glm::length(power[k]));
    power *= 1 / largest;
    power = power * power;
  }
  return *std::max_element(&power[0], &power[0] + 3, [](const Vec3& a, const Vec3& b) {
    return glm::length(a) < glm::length(b);
  });
}

/// The same of the plane across a frustum's axis: where an elliptical cylinder is thinnest.
Vec3 most_stretched_across(const Vec3& row_x, const Vec3& row_y) {
  const double angle =
      0.5 * std::atan2(2 * glm::dot(row_x, row_y), glm::dot(row_x, row_x) - glm::dot(row_y, row_y));
  return std::cos(angle) * row_x + std::sin(angle) * row_y;
}

bool is_thin_polyhedron(const CanonicalPrimitive& primitive, double thickness) {
  for (const Polyhedron::Entry& face : primitive.polyhedron->entries()) {
    if (face.skip > 0) continue;
    const Vec3 normal = face.normal * primitive.world_to_canonical;
    // Further from the canonical origin, which lies within, than all of it is thick.
    if (glm::dot(normal, normal) * thickness * thickness <= 1) continue;
    if (width(primitive, normal) < thickness) return true;
  }
  return false;
}

}  // namespace

bool is_thinner(const CanonicalPrimitive& primitive, double thickness) {
  if (primitive.shape == Shape::kPolyhedron) return is_thin_polyhedron(primitive, thickness);
  // Canonical space has it 2 thick in every direction.
  if (primitive.canonical_stretch * thickness <= 2) return false;
  const Mat3& map = primitive.world_to_canonical;
  if (primitive.shape == Shape::kSphere) return width(primitive, most_stretched(map)) < thickness;
  const Mat3 rows = glm::transpose(map);
  return width(primitive, rows[2]) < thickness ||
         width(primitive, most_stretched_across(rows[0], rows[1])) < thickness;
}

}  // namespace glrender
