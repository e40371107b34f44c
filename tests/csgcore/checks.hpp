// Random input, and truths by definition, for the tests of csgcore.
#pragma once

#include <random>
#include <set>

#include "csgcore/scene.hpp"
#include "csgcore/subdivision.hpp"
#include "support/kinds/test_kind.hpp"
#include "support/models.hpp"

namespace csgcore::checks {

double uniform(std::mt19937& random, double low, double high);
Vec3 random_point(std::mt19937& random, const Box& box);

/// Returns a primitive of any kind under a random affine map, which often keeps balls balls.
Primitive random_primitive(std::mt19937& random,
                           const test_support::SizeRange& range = test_support::SizeRange{});

using test_support::holds;
using test_support::random_direction;
using test_support::surface_point;

/// Returns whether the scene's model contains the point, by the definition above and
/// test_support::evaluate_tree.
bool holds(const Scene& scene, const Vec3& point_world);

/// Returns the value of a leaf's Blist at a point.
bool holds(const Subdivision& subdivision, const Leaf& leaf, const Vec3& point_world);

/// Returns the primitives that the solid's list names.
std::set<uint32_t> named_by(const Solid& solid);

using test_support::scene_of;

/// Returns a view of the box from outside, along `direction` (unit).
View view_of(const Box& box, const Vec3& direction, double distance);

/// Fails unless, at random points of each leaf's cell, the leaf's Blist equals the scene's
/// function, the kinds of leaves are what the enum says, and the leaves' cells make up the root
/// box.
void expect_correct(const Subdivision& subdivision, const Scene& scene, int points_per_leaf);

}  // namespace csgcore::checks
