// The convex polyhedron under affine maps. Canonical: see polyhedron.hpp.
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "csgcore/polyhedron.hpp"
#include "primitives/shapes.hpp"

namespace csgcore::polyhedron {
namespace {

/// By convexity, a cell whose 8 corners are inside is inside.
bool holds_corners(const Polyhedron& polyhedron, const CanonicalCell& cell) {
  for (int corner = 0; corner < 8; ++corner) {
    if (!polyhedron.contains(cell.corner(corner), cell.slack)) return false;
  }
  return true;
}

}  // namespace

CanonicalPrimitive canonicalize(const Primitive& primitive) {
  const Polyhedron& polyhedron = *primitive.polyhedron;
  const Polyhedron::Canonical& canonical = polyhedron.canonical();
  CanonicalPrimitive result;
  result.shape = Shape::kPolyhedron;
  result.enclosure = canonical.in_frustum ? Shape::kFrustum : Shape::kSphere;
  result.radius_mid = canonical.radius_mid;
  result.radius_slope = canonical.radius_slope;
  result.polyhedron = primitive.polyhedron;
  const Mat3& linear = primitive.local_to_world.linear;
  result.center = primitive.local_to_world.point(canonical.center);
  for (int i = 0; i < 3; ++i) result.canonical_to_world[i] = linear[i] * canonical.scale[i];
  result.world_to_canonical = inverse(result.canonical_to_world);
  // Its support along a world axis is that along the axis' row of the map.
  const Mat3 rows = glm::transpose(result.canonical_to_world);
  for (int axis = 0; axis < 3; ++axis) {
    const auto reach = [&](const Vec3& direction) {
      return glm::dot(direction, polyhedron.support(direction));
    };
    result.bounds.min[axis] = result.center[axis] - reach(-rows[axis]);
    result.bounds.max[axis] = result.center[axis] + reach(rows[axis]);
  }
  return result;
}

Classification classify(const CanonicalPrimitive& primitive, const Box& cell_world) {
  const Polyhedron& polyhedron = *primitive.polyhedron;
  const CanonicalCell cell = to_canonical(primitive, cell_world);
  if (polyhedron.contains(cell.center)) {
    return holds_corners(polyhedron, cell) ? Classification::kInside : Classification::kCrosses;
  }
  // Most of what is outside is outside of what encloses it.
  const Classification enclosure = primitive.enclosure == Shape::kSphere
                                       ? sphere::classify(primitive, cell_world)
                                       : frustum::classify(primitive, cell_world);
  if (enclosure == Classification::kOutside) return enclosure;
  // A separating direction, as frustum::classify finds it, from the normal of the face towards the
  // cell on.
  constexpr int kSteps = 8;
  Vec3 direction = glm::normalize(polyhedron.face_towards(cell.center));
  for (int step = 0; step < kSteps; ++step) {
    const Vec3 near = cell.lowest(direction);
    if (polyhedron.contains(near)) return Classification::kCrosses;
    const Vec3 gap = near - polyhedron.support(direction);
    const double along = glm::dot(gap, direction);
    if (along > cell.slack) return Classification::kOutside;
    direction -= (2.0 * along / glm::dot(gap, gap)) * gap;
  }
  return Classification::kCrosses;
}

}  // namespace csgcore::polyhedron
