// A view prepared for the shaders, in float coordinates relative to a focus.
#pragma once

#include <array>

#include "csgcore/view.hpp"
#include "gl_object.hpp"

namespace glrender {

using csgcore::Vec3;

/// The focus is a point on the view axis: in the middle of the scene's depth range, or at the eye
/// if the scene comes close to the eye. A ray is o + t·d, with t = 0 in the plane through the
/// focus. So the coordinates that reach the GPU are small, however far away the eye or the model's
/// origin is.
struct Frame {
  csgcore::View view;
  Vec3 focus{0.0};
  double eye_distance = 0;  // from the eye's plane to the focus, along the axis
  double depth_scale = 0;   // see frame.glsl
  double far_t = 0;
  double pixel_size = 0;  // world units at depth 1 (perspective) or anywhere (orthographic)
  bool visible = false;   // false: the whole scene lies behind the eye
  /// Displacement of the rays from the pixels' centres, in pixels, x to the right, y downwards.
  std::array<double, 2> displacement_px{};

  bool perspective() const { return view.projection == csgcore::Projection::kPerspective; }
  glm::vec3 relative(const Vec3& point) const { return glm::vec3(point - focus); }
};

Frame make_frame(const csgcore::View& view, const csgcore::Box& scene_box);

void set_frame_uniforms(GLuint program, const Frame& frame, double overlap);

}  // namespace glrender
