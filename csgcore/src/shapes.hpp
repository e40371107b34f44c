// The per-shape answers behind canonical_primitive.hpp; private to csgcore.
#pragma once

#include "csgcore/canonical_primitive.hpp"

namespace csgcore {

/// A parallelepiped in canonical space, the image of a cell: center ± half[0] ± half[1] ± half[2].
struct CanonicalCell {
  Vec3 center;
  Mat3 half;  // columns: the half edges
};

namespace sphere {
CanonicalPrimitive canonicalize(const Primitive& primitive);
bool contains(const Vec3& point_canonical);
/// Certain that the cell and the primitive do not meet.
bool separated(const CanonicalCell& cell);
}  // namespace sphere

namespace frustum {
CanonicalPrimitive canonicalize(const Primitive& primitive);
bool contains(const CanonicalPrimitive& primitive, const Vec3& point_canonical);
bool separated(const CanonicalPrimitive& primitive, const CanonicalCell& cell);
}  // namespace frustum

}  // namespace csgcore
