// The rays of a view, re-based near the model.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/geometry.hpp"
#include "csgcore/view.hpp"
#include "rays/ray_packet.hpp"

namespace csgcore {

/// The rays of one view, re-based near the model (NUMERICS.md, "Rays"): x(τ) = pivot + o + τ·d with
/// d the direction of pixel_ray, s = base_s + τ, and o small where the model is, however far away
/// the eye.
struct FrameRays {
  View view;
  double base_s = 0;  // of 26 bits, so that its products with half a direction are exact
  Vec3 pivot{0.0};
  /// What lies further on is seen: in perspective from the tolerance beyond the eye on (an eye in a
  /// face is not torn between its sides by rounding), everything in orthographic views.
  double first_t = 0;

  /// pixel_ray's u and v of a point of the picture, in pixels.
  double u(double x_px) const {
    return (2 * (x_px + 0.5) - view.width_px) / view.height_px * view.half_height;
  }
  double v(double y_px) const {
    return (view.height_px - 2 * (y_px + 0.5)) / view.height_px * view.half_height;
  }
  /// Of the pixels' centres, and of kBeyond_px beyond the picture: packets are filled, and read in
  /// whole vectors.
  static constexpr uint32_t kBeyond_px = 2 * kPacketWidth_px;
  std::vector<double> u_of_column, v_of_row;
};
FrameRays frame_rays(const View& view, const Box& solid_bounds);

}  // namespace csgcore
