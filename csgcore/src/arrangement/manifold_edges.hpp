// Joins the faces of a solid along its edges, two at each.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "csgcore/triangle_set.hpp"

namespace csgcore {

/// Returns whether three vertices lie on one line.
using AreOnLine = std::function<bool(uint32_t, uint32_t, uint32_t)>;

/// Divides triangles at vertices that lie on their edges, where only the faces beyond have them.
/// Then gives vertices at which several fans of triangles meet a copy for each of them, and edges
/// with four triangles and more one for each two that bound the same part of the solid: by copies
/// of its ends or, where these are connected elsewhere, by a vertex in its middle. Only edges and
/// vertices for which `may_touch` is set, by vertex, are looked at.
void make_manifold(BoundaryMesh& mesh, const std::vector<bool>& may_touch,
                   const AreOnLine& are_on_line);

}  // namespace csgcore
