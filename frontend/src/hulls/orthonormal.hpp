// Orthonormal axes along a direction.
#pragma once

#include <cmath>

#include "csgcore/geometry.hpp"

namespace frontend {

/// Orthonormal and right-handed.
struct Axes {
  csgcore::Vec3 x, y, z;

  csgcore::Mat3 matrix() const { return {x, y, z}; }
};

/// Returns axes with that z, which has unit length. They are exact for the directions of the
/// coordinate axes (Duff et al., "Building an Orthonormal Basis, Revisited", 2017).
inline Axes axes_along(const csgcore::Vec3& z) {
  const double sign = std::copysign(1.0, z.z);
  const double a = -1 / (sign + z.z);
  const double b = z.x * z.y * a;
  return {{1 + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}, z};
}

}  // namespace frontend
