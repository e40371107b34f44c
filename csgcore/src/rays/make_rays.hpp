// Makes packets of rays.
#pragma once

#include <cstdint>

#include "rays/frame_rays.hpp"
#include "rays/ray_packet.hpp"

namespace csgcore {

/// Where rays go: the directions' parts along the view's right and up.
struct alignas(64) PacketLaterals {
  double u[kPacketRays];
  double v[kPacketRays];
};
void make_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays);
/// Of the first four lanes alone, at an eighth of the cost.
void make_four_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays);
/// Through the centres of the pixels of the block from (x, y) on.
void make_block_rays(const FrameRays& frame, uint32_t x, uint32_t y, RayPacket& rays);

}  // namespace csgcore
