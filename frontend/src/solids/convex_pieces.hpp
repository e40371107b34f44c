// Solids as unions of convex ones.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "csgcore/triangle_set.hpp"
#include "solids/solid_pool.hpp"

namespace frontend {

/// Returns how many edges of the surface turn inwards.
size_t count_of_reflex_edges(const csgcore::TriangleSet& surface);

/// Points whose hull is a piece.
using PiecePoints = std::vector<csgcore::Vec3>;

/// Cuts a solid at the planes of faces where its boundary turns inwards, until all pieces are
/// convex. The surface is closed, and does not cross itself: boundary_mesh() has made it. The
/// pieces are the solid's, but for 2^-28 of its size, where its faces are not too narrow for their
/// planes to be known. Returns nothing if they would be very many, or if so many triangles would be
/// cut, over all cuts.
std::optional<std::vector<PiecePoints>> convex_pieces(csgcore::TriangleSet surface, SolidPool& pool,
                                                      size_t most_cut_triangles);

/// Whether the hulls of the pieces have the surface's volume, but for 2^-28 of its size on all of
/// its faces.
bool fill(const std::vector<PiecePoints>& pieces, const csgcore::TriangleSet& surface);

}  // namespace frontend
