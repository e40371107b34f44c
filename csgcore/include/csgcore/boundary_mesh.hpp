// The boundary of a solid as a closed mesh of triangles, by exact arithmetic (MESHES.md).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/csg_tree.hpp"
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

/// Returns the boundary of what the tree makes of the operands, which its primitives' numbers name.
/// An operand is the set of points where the winding number of its surface is not 0. Each surface
/// is closed, which is not checked, and its coordinates are finite; it may cross itself and turn
/// either way.
///
/// Coordinates are rounded once, to 2^-36 of half the longest side of the box of all operands or
/// finer; what follows is exact, and the vertices of the result are rounded to double. Of
/// coincident faces one is shown as NUMERICS.md §1.4 defines. The result does not depend on the
/// number of threads. Throws Stopped (stop_scope.hpp).
BoundaryMesh boundary_mesh(std::span<const TriangleSet> operands, const CsgTree& tree);

/// Returns the number of edges that do not have as many triangles in one direction as in the other.
size_t open_edges(const TriangleSet& surface);

}  // namespace csgcore
