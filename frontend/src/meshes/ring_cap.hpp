// Triangles that close a mesh at a ring of vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/triangle_mesh.hpp"

namespace frontend {

/// Appends triangles whose directed edges together are those of the ring, and others in both
/// directions. So they wind around every point of the ring's plane as often as the ring does, even
/// where they overlap. Of a ring of n vertices most triangles are small, and a point lies in some
/// log n of them, where the triangles between one vertex and all edges would be long.
void close_ring(std::vector<uint32_t> ring,
                std::vector<csgcore::TriangleMesh::Triangle>& triangles);

}  // namespace frontend
