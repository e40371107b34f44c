// Primitives in canonical form, and the geometric tests that the subdivision makes with them. Each
// kind implements these in a file of its own (src/primitives/primitive_kind.hpp).
#pragma once

#include <array>
#include <vector>

#include "csgcore/primitive.hpp"

namespace csgcore {

/// How a cell lies relative to a primitive. kOutside: the two are disjoint. kInside: the cell lies
/// within the primitive. Both are certain; kCrosses says only that neither could be shown.
enum class Classification : uint8_t { kOutside, kInside, kCrosses };

/// A primitive in canonical space, where it has a standard place and size: x_canonical =
/// world_to_canonical · (x_world − center).
///   kSphere:  the unit ball.
///   kFrustum: |z| ≤ 1, hypot(x, y) ≤ radius_mid + radius_slope·z, whose larger end radius is 1.
///   kPolyhedron: see polyhedron.hpp.
///   kMesh: see triangle_mesh.hpp.
///   kExtrusion: within its enclosure, a kFrustum. Its cross-section is a scaled image of the
///     profile in canonical form; see profile.hpp.
///   kRevolution: within the cylinder |z| ≤ 1, hypot(x, y) ≤ 1; see profile.hpp.
struct alignas(64) CanonicalPrimitive {
  Shape shape = Shape::kSphere;
  /// The quadric, kSphere or kFrustum, that encloses the primitive in canonical space. A sphere or
  /// a frustum is its own enclosure.
  Shape enclosure = Shape::kSphere;
  CutFaces cut_faces = CutFaces::kByTree;
  bool is_convex = true;  // a ray meets it in one segment at most
  uint32_t id = 0;
  double radius_mid = 1;
  double radius_slope = 0;
  Vec3 center{0.0};  // world position of the canonical origin
  /// Radius in world space if the primitive is a ball there, else 0.
  double ball_radius = 0;
  /// Upper bound of the factor by which a length grows from world to canonical space.
  double canonical_stretch = 1;
  Mat3 world_to_canonical{1.0};
  Mat3 canonical_to_world{1.0};
  Box bounds;  // tight, in world space
  /// Bound of the rounding error of canonical coordinates, per unit of the largest number that they
  /// are computed from: a world coordinate or an offset from the centre.
  double canonical_error = 0;
  std::shared_ptr<const Polyhedron> polyhedron;  // null unless shape is kPolyhedron
  /// What else the kind needs: a mesh or a profile (see mesh() and profile()), or numbers of its
  /// own.
  std::shared_ptr<const void> shared_shape;
  std::optional<Color> color;
  /// Bound of the part of canonical_error that the rounding of world_to_canonical causes, per unit
  /// of the largest canonical coordinate. A float keeps primitives within five cache lines.
  float inversion_error = 0;

  /// Null unless shape is kMesh.
  const TriangleMesh* mesh() const {
    return shape == Shape::kMesh ? static_cast<const TriangleMesh*>(shared_shape.get()) : nullptr;
  }
  /// Null unless shape is kExtrusion or kRevolution.
  const Profile* profile() const {
    const bool has_profile = shape == Shape::kExtrusion || shape == Shape::kRevolution;
    return has_profile ? static_cast<const Profile*>(shared_shape.get()) : nullptr;
  }
};
static_assert(sizeof(CanonicalPrimitive) == 320);

/// Returns the canonical form of a primitive. Precondition: is_valid(primitive).
CanonicalPrimitive canonicalize(const Primitive& primitive);

/// Returns the two numbers of the canonical form that a shader of the kind is given: the radii of
/// the enclosure, unless the kind has others.
std::array<double, 2> shader_numbers(const CanonicalPrimitive& primitive);

/// Classifies a cell, which is a closed, non-empty box in world space.
Classification classify(const CanonicalPrimitive& primitive, const Box& cell);

/// Does the same if the primitive is no ball (ball_radius = 0) and the cell meets its bounds.
Classification classify_within_bounds(const CanonicalPrimitive& primitive, const Box& cell);

/// Returns the primitive's point furthest along a direction, in world space, up to rounding.
Vec3 furthest_point(const CanonicalPrimitive& primitive, const Vec3& direction_world);

/// Returns an upper bound of the distance, in world units, from the primitive's `center` to any of
/// its points. It is tight if the primitive is not sheared.
double reach(const CanonicalPrimitive& primitive);

/// Returns whether the ball (radius in world units) certainly lies within the primitive.
bool holds_ball(const CanonicalPrimitive& primitive, const Vec3& center_world, double radius);

/// Returns whether `inner` certainly reaches no further than `limit` world units out of the surface
/// of `outer`. With a negative limit, all of `inner` must lie at least −limit below that surface.
bool lies_within(const CanonicalPrimitive& inner, const CanonicalPrimitive& outer, double limit);

/// Returns the distance, in world units, between the two planes perpendicular to the direction (of
/// any length but 0) that touch the primitive from both sides.
double width(const CanonicalPrimitive& primitive, const Vec3& direction_world);

/// Returns whether the primitive's width along some direction is certainly less than `thickness`,
/// in world units.
bool is_thinner(const CanonicalPrimitive& primitive, double thickness);

/// Returns whether the point lies in the closed primitive, up to the rounding of doubles.
bool contains(const CanonicalPrimitive& primitive, const Vec3& point_world);

/// How far a primitive reaches, in one cache line: all that the subdivision reads of most
/// primitives that it tests against a cell. The primitive lies within the box center ± half. A ball
/// is decided by distances from the centre alone: a cell lies outside of it if the cell's nearest
/// point is further away than √outside2, and inside if the cell's furthest point is nearer than
/// √inside2. For primitives that are no balls outside2 = +inf and inside2 = −1, which decide
/// nothing. World units.
struct alignas(64) Extent {
  double center[3];
  double half[3];
  double outside2;
  double inside2;
};

using Extents = std::vector<Extent>;

Extent extent_of(const CanonicalPrimitive& primitive);

}  // namespace csgcore
