// Support functions and membership of generators and of the primitives that are made of them, for
// tests.
#pragma once

#include <span>

#include "csgcore/primitive.hpp"
#include "hulls/generator.hpp"

namespace frontend::hull_test {

/// The largest direction · x of all points x of the hull.
double support(const Generators& generators, const csgcore::Vec3& direction);
double support(const csgcore::Primitive& primitive, const csgcore::Vec3& direction);
double support(std::span<const csgcore::Primitive> pieces, const csgcore::Vec3& direction);

/// A point of the generator that is furthest along the direction.
csgcore::Vec3 furthest(const Generator& generator, const csgcore::Vec3& direction);

/// Whether the point lies in a convex primitive or a revolution, or is nearer to it than
/// `tolerance`. Both are of similar sizes.
bool contains(const csgcore::Primitive& primitive, const csgcore::Vec3& point, double tolerance);

/// The diagonal of a box around the hull.
double size_of(const Generators& generators);

}  // namespace frontend::hull_test
