// The edges of plane figures.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace csgcore {

using Vec2 = glm::dvec2;

/// An edge of a profile, from the point where the edge before it ends.
struct ProfileEdge {
  enum class Kind : uint8_t {
    kLine,
    kArc,     // of the circle about `control` through the start; at most a half turn
    kBezier,  // quadratic, with the control point `control`
  };
  Kind kind = Kind::kLine;
  bool is_counterclockwise = true;  // an arc's direction
  Vec2 end{0.0};
  Vec2 control{0.0};
};

/// A closed loop: its last edge ends where the first one begins.
using ProfileLoop = std::vector<ProfileEdge>;

}  // namespace csgcore
