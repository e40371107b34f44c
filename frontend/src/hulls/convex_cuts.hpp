// Set operations on convex polyhedra, whose results are unions of convex polyhedra.
#pragma once

#include <span>
#include <vector>

#include "csgcore/facets.hpp"

namespace frontend {

/// Points whose hull is a convex polyhedron. Without any it is empty.
using Corners = std::vector<csgcore::Vec3>;

/// Returns what of the hull lies in the half-space; nothing if that has no volume. A corner that
/// lies on the plane, up to rounding, is on either side.
Corners cut(const Corners& corners, const csgcore::HalfSpace& half_space);

/// Returns what of the hull lies in all half-spaces.
Corners intersection(const Corners& corners, std::span<const csgcore::HalfSpace> half_spaces);

/// Returns convex polyhedra that together are the hull without the intersection of the half-spaces.
/// They touch each other.
std::vector<Corners> difference(const Corners& corners,
                                std::span<const csgcore::HalfSpace> half_spaces);

}  // namespace frontend
