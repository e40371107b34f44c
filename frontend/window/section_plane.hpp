// A plane that cuts a scene open: one more half-space, as exact as any primitive.
#pragma once

#include <cstdint>

#include "csgcore/scene.hpp"

namespace window {

/// Perpendicular to one of the world's axes. What lies beyond `position` along the axis is cut off;
/// where it is flipped, what lies before it.
struct SectionPlane {
  bool is_on = false;
  uint8_t axis = 0;  // 0, 1, 2: x, y, z
  bool is_flipped = false;
  double position = 0;  // world units
  bool operator==(const SectionPlane&) const = default;
};

/// The scene without what the plane, which is on, cuts off: of the model as of the `%` and `#`
/// parts. `bounds` holds the whole scene. The cut is a primitive behind all others, whose id is
/// kSectionId.
csgcore::Scene cut_open(const csgcore::Scene& scene, const SectionPlane& plane,
                        const csgcore::Box& bounds);

constexpr uint32_t kSectionId = 0xFFFFFFFEu;  // no file holds so many primitives

}  // namespace window
