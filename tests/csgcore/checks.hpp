// What the tests of csgcore share: random input, and what holds by definition.
#pragma once

#include <functional>
#include <random>
#include <span>

#include "csgcore/half_space.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/subdivision.hpp"
#include "support/models.hpp"

namespace csgcore::checks {

double uniform(std::mt19937& random, double low, double high);
Vec3 random_point(std::mt19937& random, const Box& box);
Vec3 random_direction(std::mt19937& random);

/// A random sphere or frustum (also pointed at either end), under a random affine map.
Primitive random_primitive(std::mt19937& random);

/// A random point of the primitive's surface, in world space; often of a rim, or a vertex.
Vec3 surface_point(const Primitive& primitive, std::mt19937& random);

/// OpenSCAD's facets of the primitive, if it is a sphere or a frustum.
Primitive faceted(const Primitive& primitive, int fragments);
/// The convex solid of 8 triangles between three skewed axes, from −1 to 1 about.
Primitive make_octahedron(const Affine& local_to_world = {});

/// How far a local point can go along a direction before it leaves all half-spaces: the least of
/// their distances.
double room_along(std::span<const HalfSpace> half_spaces, const Vec3& point, const Vec3& direction);

/// Membership by the definition of the primitive in its local space.
bool holds(const Primitive& primitive, const Vec3& point_world);

/// The scene's model, by the definition above and test_support::evaluate_tree.
bool holds(const Scene& scene, const Vec3& point_world);

/// The value of a leaf's function at a point.
bool holds(const Subdivision& subdivision, const Leaf& leaf, const Vec3& point_world);

using test_support::scene_of;

/// A view of the box from outside, along `direction` (unit).
View view_of(const Box& box, const Vec3& direction, double distance);

/// Fails unless, at random points of each leaf's cell, the leaf's function is the scene's; kinds
/// are what the enum says; and the leaves' cells make up the root box.
void expect_correct(const Subdivision& subdivision, const Scene& scene, int points_per_leaf);

}  // namespace csgcore::checks
