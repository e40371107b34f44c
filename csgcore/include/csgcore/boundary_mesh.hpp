// The boundary of a solid as a closed mesh of triangles, by exact arithmetic (MESHES.md).
#pragma once

#include <cstddef>
#include <span>

#include "csgcore/csg_tree.hpp"
#include "csgcore/triangle_set.hpp"

namespace csgcore {

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

}  // namespace csgcore
