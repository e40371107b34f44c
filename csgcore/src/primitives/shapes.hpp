// The per-shape answers behind canonical_primitive.hpp; private to csgcore.
#pragma once

#include <glm/geometric.hpp>

#include "csgcore/canonical_primitive.hpp"

namespace csgcore {

/// A parallelepiped in canonical space, the image of a cell: center ± half[0] ± half[1] ± half[2].
struct CanonicalCell {
  Vec3 center;
  Mat3 half;  // columns: the half edges
  /// How far rounding may have displaced it. A claim of certainty must hold in spite of that.
  double slack;

  /// corner: 0 to 7.
  Vec3 corner(int corner) const {
    return center + ((corner & 1) ? 1.0 : -1.0) * half[0] + ((corner & 2) ? 1.0 : -1.0) * half[1] +
           ((corner & 4) ? 1.0 : -1.0) * half[2];
  }
  /// The point least far along `direction`.
  Vec3 lowest(const Vec3& direction) const {
    Vec3 point = center;
    for (int i = 0; i < 3; ++i) {
      point -= (glm::dot(direction, half[i]) > 0 ? 1.0 : -1.0) * half[i];
    }
    return point;
  }
};

CanonicalCell to_canonical(const CanonicalPrimitive& primitive, const Box& cell);

namespace sphere {
CanonicalPrimitive canonicalize(const Primitive& primitive);
bool contains(const Vec3& point_canonical);
/// The point furthest along a canonical direction.
Vec3 support(const Vec3& direction_canonical);
Classification classify(const CanonicalPrimitive& primitive, const Box& cell);
}  // namespace sphere

namespace frustum {
CanonicalPrimitive canonicalize(const Primitive& primitive);
bool contains(const CanonicalPrimitive& primitive, const Vec3& point_canonical);
Vec3 support(const CanonicalPrimitive& primitive, const Vec3& direction_canonical);
/// A ball in canonical space.
bool holds_ball(const CanonicalPrimitive& primitive, const Vec3& center, double radius);
Classification classify(const CanonicalPrimitive& primitive, const Box& cell);
}  // namespace frustum

namespace polyhedron {
CanonicalPrimitive canonicalize(const Primitive& primitive);
Classification classify(const CanonicalPrimitive& primitive, const Box& cell);
}  // namespace polyhedron

}  // namespace csgcore
