// Random trees of all primitives under random affine maps, with coincidences planted in them.
#pragma once

#include <cstdint>

#include "cases.hpp"

namespace stress {

/// The primitives of a random scene.
enum class Leaves : uint8_t {
  kAll,
  kPolyhedra,  // convex ones
  kFaceted,    // convex polyhedra, and meshes that are small enough for Nef polyhedra
  kMeshes,     // all, and every second one is a mesh, some with holes
};

/// Up to 12 primitives within about [-10, 10]³, with up to 8 fragments, often of integer sizes.
/// Half of them share planes or an axis with an earlier one, or equal it.
Scene random_scene(uint32_t seed, Leaves leaves);

/// Returns a perspective view from around the scene, near or far, or from inside; or an
/// orthographic one, often along an axis.
View random_view(const Scene& scene, PictureSize size, uint32_t seed);

}  // namespace stress
