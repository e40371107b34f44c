#include "frame.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace glrender {
namespace {

/// The nearest depth that the depth buffer represents, as a fraction of the furthest. The buffer
/// holds floats that fall as 1/z, so that a small value costs no precision further away.
constexpr double kNearestDepth = 1e-6;
/// If the scene begins nearer than this fraction of its furthest depth, the focus is the eye:
/// errors must shrink towards the eye, as pixels do.
constexpr double kCloseUp = 1.0 / 16;
/// The far end is moved out by this fraction of the depth range, so that rounding never clamps it.
constexpr double kFarMargin = 1e-4;

}  // namespace

Frame make_frame(const csgcore::View& view, const csgcore::Box& scene_box) {
  Frame frame;
  frame.view = view;
  frame.pixel_size = 2 * view.half_height / view.height_px;
  if (scene_box.empty()) return frame;
  double nearest = std::numeric_limits<double>::infinity();
  double furthest = -nearest;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 point{(corner & 1) ? scene_box.max.x : scene_box.min.x,
                     (corner & 2) ? scene_box.max.y : scene_box.min.y,
                     (corner & 4) ? scene_box.max.z : scene_box.min.z};
    const double depth = glm::dot(point - view.eye, view.forward);
    nearest = std::min(nearest, depth);
    furthest = std::max(furthest, depth);
  }
  furthest += kFarMargin * (furthest - nearest);
  if (frame.perspective()) {
    frame.visible = furthest > 0;
    if (!frame.visible) return frame;
    nearest = std::max(nearest, kNearestDepth * furthest);
    frame.depth_scale = nearest / (furthest - nearest);
  } else {
    frame.visible = true;
    frame.depth_scale = 1 / (furthest - nearest);
  }
  const bool close_up = frame.perspective() && nearest < kCloseUp * furthest;
  frame.eye_distance = close_up ? 0 : 0.5 * nearest + 0.5 * furthest;
  frame.far_t = furthest - frame.eye_distance;
  frame.focus = view.eye + frame.eye_distance * view.forward;
  return frame;
}

void set_frame_uniforms(GLuint program, const Frame& frame, double overlap) {
  const auto set3 = [&](const char* name, const Vec3& v) {
    glUniform3f(glGetUniformLocation(program, name), static_cast<float>(v.x),
                static_cast<float>(v.y), static_cast<float>(v.z));
  };
  const auto set1 = [&](const char* name, double v) {
    glUniform1f(glGetUniformLocation(program, name), static_cast<float>(v));
  };
  const csgcore::View& view = frame.view;
  set3("u_right", view.right);
  set3("u_up", view.up);
  set3("u_forward", view.forward);
  const double aspect = static_cast<double>(view.width_px) / view.height_px;
  glUniform2f(glGetUniformLocation(program, "u_half_extent"),
              static_cast<float>(view.half_height * aspect), static_cast<float>(view.half_height));
  set1("u_eye_distance", frame.eye_distance);
  set1("u_pixel_size", frame.pixel_size);
  set1("u_depth_scale", frame.depth_scale);
  set1("u_far", frame.far_t);
  set1("u_overlap", overlap);
  glUniform2f(glGetUniformLocation(program, "u_viewport"), static_cast<float>(view.width_px),
              static_cast<float>(view.height_px));
  glUniform2f(glGetUniformLocation(program, "u_displacement"),
              static_cast<float>(frame.displacement_px[0]),
              static_cast<float>(-frame.displacement_px[1]));
}

}  // namespace glrender
