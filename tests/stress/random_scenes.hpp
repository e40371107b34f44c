// Random trees of all primitives under random affine maps, with coincidences planted in them.
#pragma once

#include <cstdint>

#include "cases.hpp"

namespace stress {

/// Up to 12 primitives of all kinds within about [-10, 10]³, with up to 8 fragments, often of
/// integer sizes. Half of them share planes or an axis with an earlier one, or equal it.
/// `only_polyhedra`: none is smooth.
Scene random_scene(uint32_t seed, bool only_polyhedra);

/// Returns a perspective view from around the scene, near or far, or from inside; or an
/// orthographic one, often along an axis.
View random_view(const Scene& scene, PictureSize size, uint32_t seed);

}  // namespace stress
