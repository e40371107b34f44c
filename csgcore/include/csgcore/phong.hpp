// The paper's light (`--shading=phong`): one positional white light with ambient, diffuse and
// specular parts (paper §3.1.2, §4). The same numbers as POV-Ray's `finish`, so that POV-Ray can
// judge the colours (paper §4.2); glrender's shader takes its constants from here.
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
/// How far the light stands to the left of and above the eye, as a share of the eye's distance from
/// the scene's centre: enough for relief, little enough that no large part faces away from it.
constexpr double kPhongLightOffset = 0.5;

/// A white point light that does not fade with distance and casts no shadow.
struct PhongLight {
  Vec3 position_world{0.0};
};

/// The light that goes with a view: to the left of and above the eye, by half the distance, along
/// the view axis, from the eye's plane to the box's centre (its absolute value, since an
/// orthographic view may have the scene behind it). At the eye for an empty box.
inline PhongLight phong_light(const View& view, const Box& scene_box) {
  if (scene_box.empty()) return {view.eye};
  const double distance = std::abs(glm::dot(scene_box.center() - view.eye, view.forward));
  const double offset = kPhongLightOffset * distance;
  return {view.eye + offset * (view.up - view.right)};
}

/// The colour, each channel in [0, 1], of a surface point. `normal` (unit) may point to either side
/// and is turned towards the viewer; `ray_direction` (any length) is that of the pixel's ray, from
/// the eye; `base` is the surface's own colour. No diffuse and no specular part where the light
/// stands behind the surface as the viewer sees it.
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
