// Round bodies whose hull is wanted, which of them can have a part in it, and their hulls
// (round_hulls.cpp).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"

namespace frontend {

/// A ball, or a disc whose normal is known elsewhere.
struct RoundBody {
  csgcore::Vec3 center{0.0};
  double radius = 0;  // ≥ 0; 0: a point
};

/// Bodies in classes of one radius, the largest first.
struct RoundBodies {
  std::vector<RoundBody> bodies;
  /// By class: one past its last body.
  std::vector<uint32_t> ends;
  /// By body: others of its class. A body that reaches as far in a direction as they do reaches as
  /// far as all of its class: those across the edges of the hull of their centres.
  std::vector<std::vector<uint32_t>> neighbors;
  double size = 0;  // of a box around them

  /// What the rounding of a support function may come to.
  double slack() const { return 0x1p-48 * size; }
};

/// Returns 128 directions that are spread evenly over the sphere.
const std::vector<csgcore::Vec3>& spread_directions();

enum class BodyKind : uint8_t { kBalls, kDiscs };

/// Leaves out bodies that the hull of those with the same radius holds, and balls within others.
RoundBodies without_inner_bodies(std::vector<RoundBody> bodies, BodyKind kind);

/// Adds a direction unless one is there that is so near that a tangent point there serves as well:
/// the point moves out of its plane by the square of that.
void add_direction(const csgcore::Vec3& direction, std::vector<csgcore::Vec3>& directions);

/// Adds primitives whose union is the convex hull of balls and points: the polyhedron of the points
/// where planes touch three balls from outside, the frusta that touch two balls, and balls. Each
/// lies within the hull, up to rounding, so that one too many does no harm. Nothing if all are
/// points on a line; of points in a plane a thin sheet. Where the arc at which a plane rolls around
/// two balls is below `least_strip` (radians), there is no frustum. Returns false, and adds some
/// pieces only, if the search for them takes too long (kMostStripSteps).
[[nodiscard]] bool add_ball_hull(std::vector<RoundBody> balls, double least_strip,
                                 std::vector<csgcore::Primitive>& pieces);

/// The convex hull of parallel discs and points is the union of that of the points and of the
/// oblique frusta between two discs: each section across z is, since its arcs belong to frusta and
/// its straight sides to the polyhedron of the points.
struct DiscHull {
  std::vector<RoundBody> discs;
  /// Where planes touch three discs, and the discs that are points.
  std::vector<csgcore::Vec3> points;
  struct Pair {
    uint32_t lower, upper;  // of `discs`, at different heights
  };
  std::vector<Pair> frusta;

  csgcore::Primitive frustum(const Pair& pair) const;
};

/// The discs are parallel to the plane z = 0. Their hull must be a solid: they are not all at one
/// height. Returns nothing if the search takes too long (kMostStripSteps).
std::optional<DiscHull> disc_hull(std::vector<RoundBody> discs);

/// Adds primitives whose union is the hull, as add_ball_hull() does.
[[nodiscard]] bool add_disc_hull(std::vector<RoundBody> discs,
                                 std::vector<csgcore::Primitive>& pieces);

}  // namespace frontend
