// Convex bodies as the hulls of a few simple ones: from primitives to generators (support_set.cpp),
// and from these to primitives (convex_solid.cpp).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"
#include "plane/figure.hpp"

namespace frontend {

/// The sum of a point, an elliptic disc and an ellipsoid: center + x·a + y·b + ball·v for all
/// x² + y² ≤ 1 and |v| ≤ 1. A torus's hull has a disc and a ball.
struct Generator {
  csgcore::Vec3 center{0.0};
  csgcore::Vec3 disc_a{0.0}, disc_b{0.0};  // both 0: there is no disc
  csgcore::Mat3 ball{0.0};                 // 0: there is no ball

  bool has_disc() const { return disc_a != csgcore::Vec3(0.0) || disc_b != csgcore::Vec3(0.0); }
  bool has_ball() const { return ball != csgcore::Mat3(0.0); }
};

/// The hull of all. Without any it is the empty set.
using Generators = std::vector<Generator>;

Generator mapped(const csgcore::Affine& map, const Generator& generator);
/// Maps all of them.
void map_all(const csgcore::Affine& map, Generators& generators);
bool is_finite(const Generator& generator);

/// A generator whose disc and ball are round.
struct RoundGenerator {
  csgcore::Vec3 center{0.0};
  csgcore::Vec3 normal{0.0, 0.0, 1.0};  // of the disc, of unit length
  double disc_radius = 0;               // 0: there is no disc
  double ball_radius = 0;               // 0: there is no ball
};

/// Generators in a frame where they are round.
struct RoundedGenerators {
  csgcore::Mat3 frame{1.0};  // to where the generators stand; nonsingular
  std::vector<RoundGenerator> generators;
  bool is_faceted = false;  // points stand for what is round in no common frame
};

/// Chords that stand for a disc which has no exact form among others: they are at most 4e-5 of its
/// radius away from it, which is less than a pixel up to radii of 25,000 pixels.
constexpr int kChordsOfDisc = 360;
/// Rings of facets that stand for an ellipsoid, and half as many as the points of a ring: 1.5e-4 of
/// the radius, less than a pixel up to radii of 6,500 pixels.
constexpr int kRingsOfBall = 90;
/// Where there are more points for all that is round, rings and chords are fewer: so many points
/// take a second.
constexpr int kMostPoints = 1 << 18;

RoundedGenerators rounded(const Generators& generators);
/// Puts points for the disc, which keep the ball.
void replace_disc(const RoundGenerator& generator, int chords, std::vector<RoundGenerator>& result);

/// Chords that stand for a disc within the outcome of set operations: 1e-3 of its radius, a pixel
/// at a radius of 1,000 pixels.
constexpr int kChordsOfCutDisc = 72;

/// Returns points whose hull is that of the generators, up to facets.
struct PointSet {
  std::vector<csgcore::Vec3> points;
  bool is_faceted = false;  // points stand for something round
};
PointSet points_of(const Generators& generators, int chords);

/// Generators of the Minkowski sum of the two hulls.
struct GeneratorSum {
  Generators generators;
  bool is_faceted = false;
  bool is_flat = false;  // it consists of points in a plane, and has no volume
};
/// Returns nothing if they would be too many.
std::optional<GeneratorSum> minkowski_sum(const Generators& a, const Generators& b);

/// Generators of what primitives span, and whether points stand for curves among them.
struct SupportSet {
  Generators generators;
  bool is_faceted = false;
};

/// Adds generators of the primitive's hull, under its matrix. Its shape is valid; its matrix may be
/// singular.
void add_support(const csgcore::Primitive& primitive, SupportSet& support);

/// Returns whether the primitive is known to be convex.
bool is_convex(const csgcore::Primitive& primitive);

/// Returns whether the loop is the boundary, counterclockwise, of a convex figure of lines and
/// arcs.
bool is_convex_loop(const csgcore::ProfileLoop& loop);

/// Primitives whose union is a convex body. Each lies within it, up to rounding.
struct ConvexSolid {
  std::vector<csgcore::Primitive> pieces;
  bool is_faceted = false;  // facets, finer than a pixel, stand for something round
};

/// Returns the hull of finite generators. It is empty if they lie on a line, and a thin sheet if
/// they lie in a plane.
ConvexSolid convex_solid(const Generators& generators);

}  // namespace frontend
