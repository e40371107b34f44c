// What csgcore asks of a kind of primitive; private to csgcore. The answers of a kind stand in one
// file (sphere.cpp, frustum.cpp, polyhedron_primitive.cpp), and those about rays in another
// (sphere-inl.hpp and so on: kind_rays-inl.hpp lists them). CSGCORE_FOR_EACH_SHAPE
// (csgcore/shape.hpp) lists the kinds, and one without answers does not link.
#pragma once

#include <glm/geometric.hpp>

#include "csgcore/canonical_primitive.hpp"

namespace csgcore {

/// The questions are those of canonical_primitive.hpp, about primitives of this kind; points,
/// directions and lengths are in canonical space, cells and bounds in world space. What has a
/// default may be left unanswered: the default is never wrong, but slower.
class PrimitiveKind {
 public:
  /// Whether the local solid is one that can be drawn (see primitive.hpp).
  virtual bool has_valid_shape(const Primitive& primitive) const = 0;
  /// What depends on the kind alone: its shape and enclosure, the radii, the centre, the maps and
  /// the bounds.
  virtual CanonicalPrimitive canonicalize(const Primitive& primitive) const = 0;
  virtual bool contains(const CanonicalPrimitive& primitive, const Vec3& point) const = 0;

  /// A point that lies at least as far along the direction as all of the solid. By default the
  /// furthest point of what encloses it.
  virtual Vec3 support(const CanonicalPrimitive& primitive, const Vec3& direction) const;
  /// By default it holds none.
  virtual bool holds_ball(const CanonicalPrimitive& primitive, const Vec3& center,
                          double radius) const;
  /// Of a cell that meets the bounds. By default the cell is crossed unless it lies outside of what
  /// encloses the solid.
  virtual Classification classify(const CanonicalPrimitive& primitive, const Box& cell) const;
  /// See lies_within. By default it is told from a ball about the inner primitive.
  virtual bool holds(const CanonicalPrimitive& outer, const CanonicalPrimitive& inner,
                     double limit) const;
  /// By default it is not known to be.
  virtual bool is_thinner(const CanonicalPrimitive& primitive, double thickness) const;

 protected:
  ~PrimitiveKind() = default;
};

const PrimitiveKind& kind_of(Shape shape);

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

}  // namespace csgcore
