// The convex hull of parallel discs and points.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "csgcore/primitive.hpp"
#include "hulls/round_bodies.hpp"

namespace frontend {

/// The hull is the union of that of the points and of the oblique frusta between two discs: each
/// section across z is, since its arcs belong to frusta and its straight sides to the polyhedron of
/// the points.
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
