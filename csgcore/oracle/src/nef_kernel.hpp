// The exact kernel of the Nef oracle: rationals behind intervals of doubles, evaluated where these
// cannot tell.
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

/// a·x + b·y + c·z + d ≤ 0 within, in world coordinates, exactly; the boundary's normal points
/// outwards.
Plane world_plane(const csgcore::HalfSpace& half_space, const csgcore::Affine& local_to_world);

}  // namespace oracle
