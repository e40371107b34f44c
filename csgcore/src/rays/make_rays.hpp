// Makes packets of rays.
#pragma once

#include <cstdint>

#include "rays/frame_rays.hpp"
#include "rays/ray_packet.hpp"

namespace csgcore {

/// The rays' u and v (view.hpp): their positions along the view's right and up.
struct alignas(64) PacketLaterals {
  double u[kPacketRays];
  double v[kPacketRays];
};
void make_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays);
/// Makes the first four lanes only, at an eighth of the cost.
void make_four_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays);
/// Makes rays through the centres of the pixels of the block whose top left pixel is (x, y).
void make_block_rays(const FrameRays& frame, uint32_t x, uint32_t y, RayPacket& rays);

}  // namespace csgcore
