#include "base/primitive_size.hpp"

#include <algorithm>
#include <cmath>

#include "csgcore/polyhedron.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;

/// No coordinate of the local solid is larger. Of a polyhedron a bound, of the order of its size.
double local_extent(const Primitive& primitive) {
  if (primitive.shape == csgcore::Shape::kPolyhedron) {
    const csgcore::Polyhedron::Canonical& canonical = primitive.polyhedron->canonical();
    double extent = 0;
    for (int axis = 0; axis < 3; ++axis) {
      extent = std::max(extent, std::abs(canonical.center[axis]) + canonical.scale[axis]);
    }
    return extent;
  }
  return std::max(
      {primitive.r_bottom, primitive.r_top, std::abs(primitive.z_min), std::abs(primitive.z_max)});
}

}  // namespace

double size_of(const Primitive& primitive) {
  double stretch = 0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      stretch = std::max(stretch, std::abs(primitive.local_to_world.linear[column][row]));
    }
  }
  return local_extent(primitive) * stretch;
}

}  // namespace frontend
