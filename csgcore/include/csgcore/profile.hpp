// Profiles: plane figures bounded by lines and curves, which are extruded or revolved to solids.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

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

/// What lies inside of the loops.
enum class FillRule : uint8_t {
  kEvenOdd,
  kNonZero,  // where the winding number is not 0
};

/// An immutable plane figure. Solids that are made of it share it.
class Profile {
 public:
  /// All coordinates must be finite. Loops may cross themselves and each other. Edges without a
  /// length are left out.
  Profile(std::vector<ProfileLoop> loops, FillRule fill_rule);

  /// The definition, whose doubles are exact.
  std::span<const ProfileLoop> loops() const { return loops_; }
  FillRule fill_rule() const { return fill_rule_; }

 private:
  std::vector<ProfileLoop> loops_;
  FillRule fill_rule_;
};

}  // namespace csgcore
