// Convex polyhedra, each the hull of points: as primitives, and what set operations leave of them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/primitive.hpp"

namespace frontend {

struct PointSolid {
  csgcore::Primitive primitive;
  bool is_sheet;  // the points lie in one plane, but for 2^-30 of their size
};

/// Returns the hull: a polyhedron, or a mesh if it has very many faces. Of points in one plane, or
/// nearly, it is a sheet: a mesh that is not closed. Nothing if the points lie on a line. All
/// coordinates must be finite. No point of the space within a solid is left out, and what is added
/// is at most 2^-45 of its size thick; a sheet of points that lie nearly in a plane may be smaller
/// by as much as these are beside it.
std::optional<PointSolid> solid_of_points(std::span<const csgcore::Vec3> points);

/// Returns the half-spaces whose intersection is the hull; none if it has no volume.
std::vector<csgcore::HalfSpace> faces_of(std::span<const csgcore::Vec3> points);

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
