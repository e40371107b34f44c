// Solids of triangles and the plane z = 0: where they meet it, and the shadow that they cast on it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "csgcore/boundary_mesh.hpp"
#include "plane/figure.hpp"

namespace frontend {

using csgcore::TriangleSet;

/// Returns figures whose union is the section of the solid with the plane, where its winding number
/// is not 0. The triangles are closed and run counterclockwise, as seen from outside. A face that
/// lies in the plane belongs to the section, on whichever side of the plane the solid is; a vertex
/// or an edge that touches the plane leaves nothing.
std::vector<Figure> section_of(const TriangleSet& solid);

enum class Boundary : uint8_t { kClosed, kOpen };

/// Returns the union of the triangles' images under (x, y, z) ↦ (x, y), as polygons that do not
/// cross themselves or each other; nothing if its edges cross too often (kMostCrossings). Triangles
/// that are kClosed run the same way around, as seen from outside; kOpen ones run in any way.
std::optional<Figure> shadow_of(const TriangleSet& solid, Boundary boundary);

}  // namespace frontend
