// Where rectangles lie relative to profiles.
#pragma once

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/profile.hpp"

namespace csgcore {

struct Rectangle {
  Vec2 min, max;
};

/// Classifies a rectangle in canonical coordinates, by the side on which a point of it lies if no
/// edge meets it. Edges where x ≤ `leftmost` count for nothing.
Classification classify(const Profile& profile, const Rectangle& rectangle, const Vec2& point,
                        double leftmost);

}  // namespace csgcore
