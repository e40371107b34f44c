// The paper's light (`--shading=phong`): one positional white light with ambient, diffuse and
// specular parts (paper §3.1.2, §4). The constants have the meaning of POV-Ray's `finish`, so that
// pictures can be compared with POV-Ray's (paper §4.2). glrender's shader uses the same constants.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "csgcore/geometry.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

constexpr double kPhongAmbient = 0.2;    // POV-Ray: ambient
constexpr double kPhongDiffuse = 0.7;    // POV-Ray: diffuse
constexpr double kPhongSpecular = 0.3;   // POV-Ray: phong
constexpr double kPhongExponent = 40.0;  // POV-Ray: phong_size
/// The distance of the light to the left of the eye, and above it, as a share of the eye's distance
/// from the scene's centre. It is enough for relief, and so little that no large part faces away
/// from the light.
constexpr double kPhongLightOffset = 0.5;

/// A white point light that does not fade with distance. Renderers draw it unhindered
/// (phong_shadows.hpp).
struct PhongLight {
  Vec3 position_world{0.0};
};

/// Returns the light of a view. It stands to the left of and above the eye, each by
/// kPhongLightOffset times the distance, along the view axis, between the eye's plane and the box's
/// centre. (The distance is absolute, since an orthographic view may have the scene behind it.) For
/// an empty box it stands at the eye.
inline PhongLight phong_light(const View& view, const Box& scene_box) {
  if (scene_box.empty()) return {view.eye};
  const double distance = std::abs(glm::dot(scene_box.center() - view.eye, view.forward));
  const double offset = kPhongLightOffset * distance;
  return {view.eye + offset * (view.up - view.right)};
}

/// Returns the colour of a surface point, each channel in [0, 1]. `normal` (of unit length) may
/// point to either side, and is turned towards the viewer. `ray_direction` (of any length) points
/// from the eye to the surface. `base` is the surface's own colour. If the light stands behind the
/// surface as the viewer sees it, there are no diffuse and no specular parts.
inline Vec3 phong_color(const Vec3& base, const Vec3& position_world, const Vec3& normal,
                        const Vec3& ray_direction, const PhongLight& light) {
  const Vec3 to_eye = -glm::normalize(ray_direction);
  const Vec3 n = glm::dot(normal, to_eye) < 0 ? -normal : normal;
  const Vec3 to_light = glm::normalize(light.position_world - position_world);
  const double cosine = glm::dot(n, to_light);
  Vec3 color = base * (kPhongAmbient + kPhongDiffuse * std::max(0.0, cosine));
  if (cosine > 0) {
    const Vec3 reflected = 2 * cosine * n - to_light;
    color += kPhongSpecular * std::pow(std::max(0.0, glm::dot(reflected, to_eye)), kPhongExponent);
  }
  return glm::min(color, Vec3(1.0));
}

}  // namespace csgcore
