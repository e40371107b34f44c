// Includes the rays of all kinds, one line for each kind. Included once per instruction set.
//
// A kind called Name has a struct NameRays with
//   kHasCaps: whether the normal at an end depends on more than its position: a frustum's end lies
//     on the wall or on a cap;
//   segment(d, primitive, center, rays): the rays' segments within the primitive, and which of
//     their ends lie on a cap;
//   normal(d, primitive, center, rays, t, on_cap): the primitive's outward unit normal at t, where
//     the ray crosses its surface.
// `center` is the primitive's centre relative to the rays' pivot.
#include "primitives/frustum-inl.hpp"
#include "primitives/polyhedron-inl.hpp"
#include "primitives/sphere-inl.hpp"
