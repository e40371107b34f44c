// Round bodies whose hull is wanted, and which of them can have a part in it.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/geometry.hpp"

namespace frontend {

/// A ball, or a disc whose normal is known elsewhere.
struct RoundBody {
  csgcore::Vec3 center{0.0};
  double radius = 0;  // ≥ 0; 0: a point
};

/// Bodies in classes of one radius, the largest first.
struct RoundBodies {
  std::vector<RoundBody> bodies;
  /// By class: one past its last body.
  std::vector<uint32_t> ends;
  /// By body: others of its class. A body that reaches as far in a direction as they do reaches as
  /// far as all of its class: those across the edges of the hull of their centres.
  std::vector<std::vector<uint32_t>> neighbors;
  double size = 0;  // of a box around them

  /// What the rounding of a support function may come to.
  double slack() const { return 0x1p-48 * size; }
};

enum class BodyKind : uint8_t { kBalls, kDiscs };

/// Leaves out bodies that the hull of those with the same radius holds, and balls within others.
RoundBodies without_inner_bodies(std::vector<RoundBody> bodies, BodyKind kind);

/// Adds a direction unless one is there that is so near that a tangent point there serves as well:
/// the point moves out of its plane by the square of that.
void add_direction(const csgcore::Vec3& direction, std::vector<csgcore::Vec3>& directions);

}  // namespace frontend
