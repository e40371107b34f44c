// The exact kernel of the Nef oracle, the vertices and facets of convex polyhedra, and the shells
// of triangle meshes.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <type_traits>
#include <vector>

#include "csgcore/geometry.hpp"
#include "oracle/nef_solid.hpp"

namespace oracle {

/// Rationals behind intervals of doubles, which are evaluated only if the intervals do not suffice.
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Plane = Kernel::Plane_3;

inline Point point_of(const csgcore::Vec3& p) { return {p.x, p.y, p.z}; }
inline Vector vector_of(const csgcore::Vec3& v) { return {v.x, v.y, v.z}; }

static_assert(std::is_same_v<Kernel::Exact_kernel::FT, Rational>);

inline Rational rational_of(const Number& number) { return number.exact(); }

/// Returns the exact boundary plane of the half-space in world coordinates, whose normal points
/// outwards: a·x + b·y + c·z + d ≤ 0 inside.
Plane world_plane(const csgcore::HalfSpace& half_space, const csgcore::Affine& local_to_world);

/// The corners of a facet lie exactly in its plane, counterclockwise as seen from outside.
struct Polytope {
  std::vector<Point> vertices;
  std::vector<std::vector<std::size_t>> facets;
};

/// Returns the polytope in world coordinates. Throws std::invalid_argument if the half-spaces have
/// no common interior, or an unbounded one.
Polytope polytope_of(const FacetedSolid& polyhedron);

/// A part of a mesh that is connected by edges, in world coordinates. The polytope faces outwards.
struct MeshShell {
  Polytope polytope;
  bool is_inward = false;  // whether the winding number is less within it than around it
};

/// Returns the shells of a solid that is a mesh. Throws std::invalid_argument if they are not
/// closed, intersect themselves, or have triangles without an area.
std::vector<MeshShell> shells_of(const FacetedSolid& solid);

/// Returns the planes of its triangles, except those without an area.
std::vector<Plane> triangle_planes(const FacetedSolid& solid);

}  // namespace oracle
