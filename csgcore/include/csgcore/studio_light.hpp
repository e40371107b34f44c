// The studio's light (`--shading=studio`): a key light from the viewer's upper left, a fill light
// and what comes from all around, all of them distant and white. Renderers draw it unhindered; what
// the solid itself keeps from its faces is taken away after that (light_tracer.hpp). glrender's
// shader uses the same constants.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>

#include "csgcore/geometry.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

// Their sum over a face that looks at the viewer is 0.8, and nowhere above 1.
constexpr double kStudioAmbient = 0.36;
constexpr double kStudioKey = 0.56;
constexpr double kStudioFill = 0.18;
/// The share of the light from all around that faces throw back: a hollow's walls light each other,
/// without which one could not see into it.
constexpr double kStudioReflection = 0.5;
/// Towards the lights in eye space: to the right, upwards, towards the viewer. Of any length.
constexpr double kStudioKeyDirection[3] = {-0.55, 0.75, 0.7};
constexpr double kStudioFillDirection[3] = {0.8, -0.1, 0.6};

/// Directions towards the lights: unit, world space.
struct StudioLight {
  Vec3 key{0, 0, 1};
  Vec3 fill{0, 0, 1};
};

inline StudioLight studio_light(const View& view) {
  const auto in_world = [&](const double(&eye)[3]) {
    return glm::normalize(eye[0] * view.right + eye[1] * view.up - eye[2] * view.forward);
  };
  return {in_world(kStudioKeyDirection), in_world(kStudioFillDirection)};
}

/// Returns the light from all around at a point that sees this share of the sky, and walls where
/// the light is the same: E = open + (1 − open) · kStudioReflection · E.
inline double sky_and_walls(double open) { return open / (1 - kStudioReflection * (1 - open)); }

/// Returns the share of a face's colour that is seen. `normal` is of unit length, and on the
/// viewer's side. `open`: the share of the sky that reaches the point; `key`: that of the key
/// light. Each is in [0, 1].
inline double studio_shade(const StudioLight& light, const Vec3& normal, double open, double key) {
  return sky_and_walls(open) *
             (kStudioAmbient + kStudioFill * std::max(0.0, glm::dot(normal, light.fill))) +
         key * kStudioKey * std::max(0.0, glm::dot(normal, light.key));
}

}  // namespace csgcore
