// The strips of the hull of round bodies: where a plane that rolls around the hull touches two of
// them.
//
// The tangent planes of two bodies are a circle of them. Each other body leaves of that circle the
// planes that it does not stick out of, which is a linear condition (CircleArcs). At the ends of
// the arcs that all bodies leave, the plane touches a third one. All of that is right up to
// rounding in the plane's direction, where it matters by its square; and a plane that is kept
// although a body sticks out of it, by rounding, adds nothing that is not in the hull.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hulls/circle_arcs.hpp"
#include "hulls/point_hull.hpp"

namespace frontend {

/// Arcs of an angle below this (radians) are no strips: what is missing of a body of radius 1 there
/// is thinner than 2^-49.
constexpr double kLeastStrip = 0x1p-23;

/// Calls visit(i, j, circle, arcs) for the pairs that have arcs. `Bodies` has size(), is_round(i),
/// circle(i, j) → an optional, and cut(circle, i, j, k, arcs). Pairs of points are left out.
template <typename Bodies, typename Visit>
void visit_strips(const Bodies& bodies, const Visit& visit) {
  const auto count = static_cast<uint32_t>(bodies.size());
  CircleArcs arcs;
  std::vector<uint32_t> order(count);  // bodies that lately left nothing come first
  for (uint32_t k = 0; k < count; ++k) order[k] = k;
  for (uint32_t i = 0; i < count; ++i) {
    for (uint32_t j = i + 1; j < count; ++j) {
      if (!bodies.is_round(i) && !bodies.is_round(j)) continue;
      const auto circle = bodies.circle(i, j);
      if (!circle) continue;
      arcs.reset();
      for (size_t at = 0; at < count && !arcs.is_empty(); ++at) {
        const uint32_t k = order[at];
        if (k == i || k == j) continue;
        bodies.cut(*circle, i, j, k, arcs);
        if (arcs.is_empty()) std::rotate(order.begin(), order.begin() + at, order.begin() + at + 1);
      }
      if (!arcs.is_empty()) visit(i, j, *circle, arcs);
    }
  }
}

/// Does the same for bodies of one size, which are those of the hull's corners, in their order:
/// only the edges of the hull of their centres have strips, and the two faces of an edge bound it.
template <typename Bodies, typename Visit>
void visit_strips_of_edges(const Bodies& bodies, const PointHull& hull, const Visit& visit) {
  std::vector<uint32_t> body(hull.corners.empty() ? 0 : hull.corners.back() + 1);
  for (uint32_t i = 0; i < hull.corners.size(); ++i) body[hull.corners[i]] = i;
  CircleArcs arcs;
  for (uint32_t t = 0; t < hull.triangles.size(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t other = hull.neighbors[t][k];
      if (other < t) continue;
      const PointHull::Triangle& own = hull.triangles[t];
      const uint32_t i = body[own[k]], j = body[own[(k + 1) % 3]];
      if (!bodies.is_round(i) && !bodies.is_round(j)) continue;
      const auto circle = bodies.circle(i, j);
      if (!circle) continue;
      arcs.reset();
      bodies.cut(*circle, i, j, body[own[(k + 2) % 3]], arcs);
      for (const uint32_t corner : hull.triangles[other]) {
        const uint32_t third = body[corner];
        if (third != i && third != j) bodies.cut(*circle, i, j, third, arcs);
      }
      if (!arcs.is_empty()) visit(i, j, *circle, arcs);
    }
  }
}

}  // namespace frontend
