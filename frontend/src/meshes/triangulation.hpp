// Triangles for a polygon of the plane.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace frontend {

/// Appends the triangles of a polygon to `triangles`. Its corners, at least three, are vertices by
/// their numbers; `places` has the place of each corner in the plane. Vertices of different numbers
/// are different vertices even at one place. The directed edges of all triangles together are those
/// of the polygon, and others in both directions: triangles run as the polygon runs around them,
/// and are repeated where it winds around them several times.
///
/// They are the constrained Delaunay triangulation of the polygon, which may touch itself in
/// corners, and may follow an edge in both directions, as to a hole and back. Where Delaunay's
/// criterion leaves a choice, no edge is drawn from the least vertex, by x and then by y. So
/// the result does not depend on the corner at which the polygon starts.
///
/// A polygon that crosses itself, or that has a corner on another edge, gets the triangles between
/// its first corner and its other edges, which overlap. So may one of tens of
/// thousands of corners, since the work is bounded; others of that size are Delaunay's in parts
/// only.
void triangulate(std::span<const uint32_t> corners, std::span<const glm::dvec2> places,
                 std::vector<std::array<uint32_t, 3>>& triangles);

/// Appends the triangles of several polygons as triangulate() does for one: together they wind
/// around each triangle, so that a polygon that runs clockwise is a hole in the one around it.
/// `ends` has one past the last corner of each. Polygons that cross each other are triangulated one
/// by one.
void triangulate_all(std::span<const uint32_t> corners, std::span<const uint32_t> ends,
                     std::span<const glm::dvec2> places,
                     std::vector<std::array<uint32_t, 3>>& triangles);

/// The same for a face that is seen from the other side: its triangles run the other way.
void triangulate_all_reversed(std::span<const uint32_t> corners, std::span<const uint32_t> ends,
                              std::span<const glm::dvec2> places,
                              std::vector<std::array<uint32_t, 3>>& triangles);

}  // namespace frontend
