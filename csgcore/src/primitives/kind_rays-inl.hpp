// The kinds' answers about rays: one line a kind. Included once per instruction set.
//
// A kind called Name answers by a struct NameRays with
//   kHasCaps: whether the ends of a segment differ by more than their place, as a frustum's do:
//   some
//     lie on its wall and some on its caps;
//   segment(d, primitive, center, rays): where the rays are within the primitive, and which of the
//     two ends lie on a cap;
//   normal(d, primitive, center, rays, t, on_cap): its outward unit normal at τ = t, where a ray
//     crosses its surface.
// `center` is the primitive's, relative to the rays' pivot.
#include "primitives/frustum-inl.hpp"
#include "primitives/polyhedron-inl.hpp"
#include "primitives/sphere-inl.hpp"
