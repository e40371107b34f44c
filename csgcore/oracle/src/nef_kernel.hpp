// The exact kernel of the Nef oracle: rationals behind intervals of doubles, which are evaluated
// only if the intervals do not suffice.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <type_traits>

#include "csgcore/geometry.hpp"
#include "oracle/nef_solid.hpp"

namespace oracle {

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

}  // namespace oracle
