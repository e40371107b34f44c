// The roof over an outline: it rises from the outline at unit slope.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "csgcore/geometry.hpp"
#include "plane/outlines.hpp"

namespace frontend {

/// The faces of a roof, and the outline that they stand on.
struct Roof {
  std::vector<csgcore::Vec3> points;  // no two are at one place
  /// The corners of the faces, counterclockwise as seen from above; points by their numbers. A face
  /// lies in a plane through an edge of the outline, or through a reflex corner.
  std::vector<uint32_t> corners;
  std::vector<uint32_t> ends;  // by face: one past its last corner
  /// The polygons of the outline, likewise: those around it run counterclockwise, those around
  /// holes clockwise.
  std::vector<uint32_t> outline;
  std::vector<uint32_t> outline_ends;
  size_t bevel_count = 0;  // planes that stand for cones
};

/// Returns the roof by the straight skeleton of the outline: each edge moves inwards at unit speed,
/// and the roof is as high as the time at which it passes. `bevel_step`, in radians, makes it
/// approach the one by the Voronoi diagram, whose height is the distance to the outline: a reflex
/// corner, which has a cone there, is replaced by tangent planes of the cone that are turned
/// against each other by that at most, which are lower by 1 − cos(bevel_step / 2) of the height at
/// most. (M. Tănase, R. C. Veltkamp, "A Straight Skeleton Approximating the Medial Axis", European
/// Symposium on Algorithms, 2004.) 0: none.
///
/// Heights are within 1e-10 of the size of the outline. Takes about n log n steps for n edges.
/// Nothing if the skeleton cannot be found, which polygons that cross each other cause.
std::optional<Roof> roof_over(const SimplePolygons& outline, double bevel_step);

}  // namespace frontend
