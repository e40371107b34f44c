// Primitives in canonical form, and the questions that the subdivision asks of them. Each kind
// answers them in a file of its own (src/primitives/primitive_kind.hpp).
#pragma once

#include "csgcore/primitive.hpp"

namespace csgcore {

/// Where a primitive lies against a cell. Conservative: kInside and kOutside are certain.
enum class Classification : uint8_t { kOutside, kInside, kCrosses };

/// Canonical space: x_canonical = world_to_canonical · (x_world − center).
///   kSphere:  the unit ball.
///   kFrustum: |z| ≤ 1, hypot(x, y) ≤ radius_mid + radius_slope·z, whose larger end radius is 1.
///   kPolyhedron: see polyhedron.hpp.
struct alignas(64) CanonicalPrimitive {
  Shape shape = Shape::kSphere;
  /// kSphere or kFrustum: what encloses a polyhedron in canonical space; of others their own shape.
  Shape enclosure = Shape::kSphere;
  double radius_mid = 1;
  double radius_slope = 0;
  Vec3 center{0.0};  // world position of the canonical origin
  /// Radius in world space of what is a true ball there, else 0.
  double ball_radius = 0;
  /// Upper bound of how much longer than in world space a distance is in canonical space.
  double canonical_stretch = 1;
  Mat3 world_to_canonical{1.0};
  Mat3 canonical_to_world{1.0};
  Box bounds;  // tight, in world space
  /// Bound of the rounding error of canonical coordinates, per unit of the largest world coordinate
  /// (or offset from the centre) that they are computed from.
  double canonical_error = 0;
  /// Bound of what the rounding of world_to_canonical alone does, relative to the largest canonical
  /// coordinate.
  double inversion_error = 0;
  std::shared_ptr<const Polyhedron> polyhedron;  // of a polyhedron, else null
  std::optional<Color> color;
  uint32_t id = 0;
};

/// Precondition: is_valid(primitive).
CanonicalPrimitive canonicalize(const Primitive& primitive);

/// The cell is a closed, non-empty box.
Classification classify(const CanonicalPrimitive& primitive, const Box& cell);

/// The same for what is no true ball and a cell that meets the bounds.
Classification classify_within_bounds(const CanonicalPrimitive& primitive, const Box& cell);

/// The point furthest along a direction, in world space but for rounding.
Vec3 furthest_point(const CanonicalPrimitive& primitive, const Vec3& direction_world);

/// Upper bound of how far from its centre the primitive reaches, in world units; tight for what is
/// not sheared.
double reach(const CanonicalPrimitive& primitive);

/// Whether the ball, of a radius in world units, certainly lies in the primitive.
bool holds_ball(const CanonicalPrimitive& primitive, const Vec3& center_world, double radius);

/// Whether a primitive certainly reaches no further than `limit` beyond another one's surface, in
/// world units; or stays −limit within it, where that is negative.
bool lies_within(const CanonicalPrimitive& inner, const CanonicalPrimitive& outer, double limit);

/// The distance, in world units, of the two planes across a direction, of any length, that the
/// primitive just lies between.
double width(const CanonicalPrimitive& primitive, const Vec3& direction_world);

/// Whether the primitive is certainly thinner than that, in world units, across some direction.
bool is_thinner(const CanonicalPrimitive& primitive, double thickness);

/// Membership in the closed solid, as exact as double evaluates it.
bool contains(const CanonicalPrimitive& primitive, const Vec3& point_world);

}  // namespace csgcore
