// Figures for the tests of profiles, and what they are by definition, in extended precision.
#pragma once

#include <random>
#include <vector>

#include "csgcore/primitive.hpp"
#include "csgcore/profile.hpp"
#include "support/reference_primitive.hpp"

namespace csgcore::checks {

/// Returns a loop of lines.
ProfileLoop polygon(const std::vector<Vec2>& points);
/// Returns a circle of arcs, the first of which begins at an angle in radians.
ProfileLoop circle(const Vec2& center, double radius, int arcs, bool is_counterclockwise = true,
                   double first_angle = 0);

/// Returns up to three loops of up to `most` edges, which may cross themselves and each other. Many
/// vertices have small integers as coordinates.
std::vector<ProfileLoop> random_loops(std::mt19937& random, int most = 12);
/// Moves the loops to where x is at least some number ≥ 0, often 0.
std::vector<ProfileLoop> beside_axis(std::vector<ProfileLoop> loops, std::mt19937& random);

std::shared_ptr<const Profile> random_profile(std::mt19937& random, bool is_beside_axis);

/// A point of an edge, in the edge's own parameter from 0 to 1, with the tangent.
struct EdgePoint {
  Vec2 place, tangent;
};
EdgePoint edge_point(const Vec2& start, const ProfileEdge& edge, double at);

/// Returns whether the figure contains a point, by the windings of its edges, each of which is
/// divided where it is highest or lowest and then searched by bisection.
bool holds(std::span<const ProfileLoop> loops, FillRule fill_rule, Real x, Real y);

/// The same of an extrusion or a revolution, in local coordinates.
bool holds_local(const Primitive& primitive, const LongVec3& point);

/// Returns whether a point, in local coordinates, is next to an extrusion's apex, or is made of one
/// next to a vertex of the profile, where faces meet at any angle, or to a line, which may lie in
/// another one.
bool is_at_edge(const Primitive& primitive, const LongVec3& point);

}  // namespace csgcore::checks
