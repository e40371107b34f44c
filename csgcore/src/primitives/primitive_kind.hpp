// The interface that each kind of primitive implements, in a file of its own (sphere.cpp,
// frustum.cpp, polyhedron_primitive.cpp). Another file implements its rays (sphere-inl.hpp and so
// on: primitive-inl.hpp lists those of convex kinds, kind_crossings-inl.hpp the others).
// CSGCORE_FOR_EACH_SHAPE (csgcore/shape.hpp) lists the kinds, and a kind without an implementation
// does not link.
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/facets.hpp"

namespace csgcore {

/// The functions of canonical_primitive.hpp for primitives of one kind. Points, directions and
/// lengths are in canonical space, cells and bounds in world space. Functions with a default need
/// not be overridden: the defaults are never wrong, but less sharp or slower.
class PrimitiveKind {
 public:
  /// Implements has_valid_shape() of primitive.hpp.
  virtual bool has_valid_shape(const Primitive& primitive) const = 0;
  /// Implements faceted_mesh() of facets.hpp; by default it is empty.
  virtual Mesh faceted_mesh(const Primitive& primitive, int fragments) const;
  /// Implements faceted_polyhedron() of polyhedron.hpp; by default there is none.
  virtual std::shared_ptr<const Polyhedron> faceted_polyhedron(const Primitive& primitive,
                                                               int fragments) const;
  /// Returns whether two valid primitives have equal local solids; by default, whether their
  /// numbers and what they point to are the same. Equal ones may be taken for different ones.
  virtual bool has_same_solid(const Primitive& a, const Primitive& b) const;
  /// Does the same for canonical forms with equal maps and radii; by default, whether they share
  /// what they point to.
  virtual bool has_same_form(const CanonicalPrimitive& a, const CanonicalPrimitive& b) const;
  /// Fills the members that depend on the kind: the enclosure, the radii, the centre and the
  /// maps, and the bounds if support() would not give them.
  virtual CanonicalPrimitive canonicalize(const Primitive& primitive) const = 0;
  /// Implements shader_numbers().
  virtual std::array<double, 2> shader_numbers(const CanonicalPrimitive& primitive) const;
  virtual bool contains(const CanonicalPrimitive& primitive, const Vec3& point) const = 0;

  /// Returns a point that lies at least as far along the direction as all of the solid; by default,
  /// the furthest point of the enclosure.
  virtual Vec3 support(const CanonicalPrimitive& primitive, const Vec3& direction) const;
  /// By default it is false.
  virtual bool holds_ball(const CanonicalPrimitive& primitive, const Vec3& center,
                          double radius) const;
  /// Classifies a cell that meets the bounds; by default as kOutside if it lies outside of the
  /// enclosure, else as kCrosses.
  virtual Classification classify(const CanonicalPrimitive& primitive, const Box& cell) const;
  /// Implements lies_within(); by default, by a ball around the inner primitive. `limit` is in
  /// world units.
  virtual bool holds(const CanonicalPrimitive& outer, const CanonicalPrimitive& inner,
                     double limit) const;
  /// Returns a normal of the surface near the point, of any length, or 0 if there is none to tell;
  /// by default 0. A direction that is off makes the bounds that use it less sharp, never wrong.
  virtual Vec3 outwards(const CanonicalPrimitive& primitive, const Vec3& point) const;
  /// Implements is_thinner(), with `thickness` in world units; by default it is false.
  virtual bool is_thinner(const CanonicalPrimitive& primitive, double thickness) const;

 protected:
  ~PrimitiveKind() = default;
};

const PrimitiveKind& kind_of(Shape shape);

/// The image of a cell in canonical space, a parallelepiped: center ± half[0] ± half[1] ± half[2].
struct CanonicalCell {
  Vec3 center;
  Mat3 half;  // the columns are half the edges
  /// Bound of its displacement by rounding, within which certain claims must stay true.
  double slack;

  /// Returns a corner, 0 ≤ corner < 8.
  Vec3 corner(int corner) const {
    return center + ((corner & 1) ? 1.0 : -1.0) * half[0] + ((corner & 2) ? 1.0 : -1.0) * half[1] +
           ((corner & 4) ? 1.0 : -1.0) * half[2];
  }
  /// Returns half the sides of a box around the cell, with its slack.
  Vec3 half_box() const {
    return Vec3(slack) + glm::abs(half[0]) + glm::abs(half[1]) + glm::abs(half[2]);
  }
  /// Returns the point that is least far along `direction`.
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
