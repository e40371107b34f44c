// The rays of a view, re-based near the model, and packets of them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "csgcore/geometry.hpp"
#include "csgcore/view.hpp"
#include "rays/ray_packet.hpp"

namespace csgcore {

/// The rays of one view, re-based near the model (NUMERICS.md, "Rays"): x(t) = pivot + o + t·d,
/// where d is the direction of pixel_ray and s = base_s + t. o is small where the model is, however
/// far away the eye.
struct FrameRays {
  View view;
  double base_s = 0;  // of 26 bits, so that its products with half a direction are exact
  Vec3 pivot{0.0};
  /// Only t > first_t is seen. In perspective, sight starts at the thickness tolerance beyond the
  /// eye, so that rounding cannot put an eye in a face on either side of it. An orthographic view
  /// sees everything.
  double first_t = 0;

  /// pixel_ray's u and v at a coordinate of the picture, in pixels.
  double u(double x_px) const {
    return (2 * (x_px + 0.5) - view.width_px) / view.height_px * view.half_height;
  }
  double v(double y_px) const {
    return (view.height_px - 2 * (y_px + 0.5)) / view.height_px * view.half_height;
  }
  /// u and v of the pixels' centres, and of kBeyond_px more beyond the picture, since packets are
  /// filled in whole and read in whole vectors.
  static constexpr uint32_t kBeyond_px = 2 * kPacketWidth_px;
  struct Centers {
    std::vector<double> u_of_column, v_of_row;
  };
  std::shared_ptr<const Centers> centers;
};
FrameRays frame_rays(const View& view, const Box& solid_bounds);
/// Returns frame_rays(frame.view, solid_bounds), which shares the pixels' centres.
FrameRays rebased(const FrameRays& frame, const Box& solid_bounds);

/// The rays' u and v (view.hpp): their positions along the view's right and up.
struct alignas(64) PacketLaterals {
  double u[kPacketRays];
  double v[kPacketRays];
};
/// Makes a packet of rays.
void make_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays);
/// Makes the first four lanes only, at an eighth of the cost.
void make_four_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays);
/// Makes rays through the centres of the pixels of the block whose top left pixel is (x, y).
void make_block_rays(const FrameRays& frame, uint32_t x, uint32_t y, RayPacket& rays);

}  // namespace csgcore
