// The edges of an outline from which a roof rises.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plane/figure.hpp"

namespace frontend {

/// An edge of the outline, with the region that the roof covers on its left. It moves into the
/// region at unit speed, and so do its neighbours: its ends run along with the corners between.
struct RoofEdge {
  uint32_t start_corner = 0, end_corner = 0;
  Vec2 start{0.0}, end{0.0};  // equal: it bevels a reflex corner, and has no length yet
  Vec2 direction{0.0};        // of unit length
  uint32_t next = 0;          // the edge that follows around the region
  Vec2 end_velocity{0.0};     // of the corner between this edge and the next one
  /// How far the ends have moved apart along the edge at the time 1, where the corner at the end is
  /// reflex; 0 at a convex one.
  double start_reach = 0, end_reach = 0;

  Vec2 normal() const { return {-direction.y, direction.x}; }
  /// Returns how far the point lies ahead of the edge at that time; negative: behind it.
  double ahead(const Vec2& point, double time) const {
    return glm::dot(point - start, normal()) - time;
  }
};

/// The velocity of the corner between two edges that move at unit speed. They are not parallel, or
/// run the same way.
Vec2 corner_velocity(const Vec2& direction_before, const Vec2& direction_after);

/// Returns whether the boundary turns right from one edge to the next, by more than rounding.
bool is_reflex(const Vec2& direction_before, const Vec2& direction_after);

struct RoofEdges {
  std::vector<RoofEdge> edges;
  std::vector<Vec2> corners;     // by their numbers; no two are at one place
  std::vector<double> shortest;  // by corner: its shortest edge before it is jittered
};

/// Returns the edges of the region that polygons bound: those around it run counterclockwise, those
/// around its holes clockwise. Corners at which the boundary does not turn are no corners; where
/// it touches itself, each part of the region has corners of its own. A reflex corner is bevelled,
/// so that the boundary turns there by `bevel_step` (radians) at most at a time, if that is given.
/// Each corner is moved by a random share, from −jitter to jitter, of the shortest edge at it.
RoofEdges roof_edges(std::span<const Polygon> polygons, double bevel_step, double jitter);

}  // namespace frontend
