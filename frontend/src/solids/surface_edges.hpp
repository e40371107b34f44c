// The edges of closed surfaces of triangles, and how the solid turns at them.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/boundary_mesh.hpp"

namespace frontend {

/// An edge between two triangles, and how far the one reaches over the plane of the other.
struct SurfaceEdge {
  uint32_t from, to;  // vertices, in the direction in which the left triangle passes the edge
  uint32_t left, right;
  double height;  // of the right triangle's third vertex over the left triangle's plane

  bool is_reflex(double slack) const { return height > slack; }
  bool is_convex(double slack) const { return height < -slack; }
};

/// Returns the edges of the surface, each once, which is closed and has no two vertices at one
/// place. Where more than two triangles meet in an edge, pairs of them have it, and it counts as
/// reflex.
std::vector<SurfaceEdge> edges_of(const csgcore::TriangleSet& surface);

/// Heights up to this are rounding.
double slack_of(const csgcore::TriangleSet& surface);

/// Returns the number of each triangle's connected piece of the surface, from 0.
std::vector<uint32_t> pieces_of(const csgcore::TriangleSet& surface,
                                const std::vector<SurfaceEdge>& edges);

/// Makes vertices at the same place one vertex, and leaves out triangles that name one twice.
void join_vertices(csgcore::TriangleSet& surface);

}  // namespace frontend
