// Scenes made in memory for tests and benchmarks.
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "csgcore/scene.hpp"

namespace test_support {

/// The paper's CSn: a cylinder r = 10, h = 20 minus n spheres of radius 20/√n, centred uniformly on
/// its surface.
csgcore::Scene cylinder_minus_spheres(uint32_t n, uint32_t seed = 1);

/// The paper's CCn: the same cylinder minus n cones that bite through the surface, apex inwards:
/// base radius 26/√n, height 4 times that, two thirds of it inside, tilted by up to 40°.
csgcore::Scene cylinder_minus_cones(uint32_t n, uint32_t seed = 1);

/// A turned vase of stacked rings, each a frustum minus a thinner one, all of them coaxial.
/// Neighbours share rims and faces, which no cell separates.
csgcore::Scene stacked_frusta(uint32_t rings);

/// A random tree of `primitives` spheres, cylinders and cones under random affine maps (sheared,
/// mirrored, unevenly scaled), within about [-10, 10]³.
csgcore::Scene random_tree(uint32_t primitives, uint32_t seed);

/// A random tree like random_tree(), of primitives of all kinds. It changes when a kind is added.
csgcore::Scene random_tree_of_all_kinds(uint32_t primitives, uint32_t seed);

/// One operation over the primitives, whose ids are their indices.
csgcore::Scene scene_of(csgcore::Op op, std::vector<csgcore::Primitive> primitives);

/// The convex solid of 8 triangles between three skewed axes, from about −scale to scale.
std::shared_ptr<const csgcore::Polyhedron> octahedron(double scale = 1);

/// A random affine map of moderate condition.
csgcore::Affine random_affine(std::mt19937& random);

}  // namespace test_support
