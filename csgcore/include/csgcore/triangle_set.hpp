// Surfaces of triangles, as numbers alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "csgcore/geometry.hpp"

namespace csgcore {

/// A surface: corners, and triangles of their indices, counterclockwise seen from outside.
struct TriangleSet {
  std::vector<Vec3> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
  /// It is known to be in one piece, and not to cross or touch itself, which saves time.
  bool is_simple = false;
};

/// The boundary of a solid. Each edge has two triangles, which run through it in opposite
/// directions; where four or more faces of the solid meet in an edge, the edge is there once for
/// each two of them, with vertices of its own.
struct BoundaryMesh : TriangleSet {
  std::vector<uint32_t> operands;  // by triangle: the operand whose face it is part of
};

/// Returns the number of edges that do not have as many triangles in one direction as in the other.
size_t open_edges(const TriangleSet& surface);

}  // namespace csgcore
