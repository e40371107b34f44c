// Round bodies whose hull is wanted, and which of them can have a part in it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "csgcore/geometry.hpp"
#include "hulls/point_hull.hpp"

namespace frontend {

/// A ball, or a disc whose normal is known elsewhere.
struct RoundBody {
  csgcore::Vec3 center{0.0};
  double radius = 0;  // ≥ 0; 0: a point
};

struct RoundBodies {
  std::vector<RoundBody> bodies;
  /// Of the centres, if all radii are the same and the centres span a solid. Its corners are the
  /// bodies, in their order.
  std::optional<PointHull> hull_of_centers;
  double size = 0;  // of a box around them

  /// What the rounding of a support function may come to.
  double slack() const { return 0x1p-48 * size; }
};

/// Leaves out bodies that the hull of those with the same radius holds.
RoundBodies without_inner_bodies(std::vector<RoundBody> bodies);

/// Adds a direction unless one is there that is so near that a tangent point there serves as well:
/// the point moves out of its plane by the square of that.
void add_direction(const csgcore::Vec3& direction, std::vector<csgcore::Vec3>& directions);

}  // namespace frontend
