// The edges of a triangle mesh: whether it is closed, and which way its triangles should face.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace csgcore {

/// Indices of vertices.
using EdgedTriangle = std::array<uint32_t, 3>;

/// Returns whether each edge is passed as often in one direction as in the other. An edge is added
/// for one direction and subtracted for the other, as two random numbers: a mesh that is not closed
/// has a sum of 0 with a probability of 2⁻¹²⁸.
bool is_balanced(std::span<const EdgedTriangle> triangles);

/// Returns how many edges are passed more often in one direction than in the other.
uint64_t count_open_edges(std::span<const EdgedTriangle> triangles);

/// Turns triangles so that neighbours across an edge which only they share pass it in opposite
/// directions, as far as that is possible. In each part that is connected by such edges, the
/// majority stays as it is.
void face_alike(std::span<EdgedTriangle> triangles);

}  // namespace csgcore
