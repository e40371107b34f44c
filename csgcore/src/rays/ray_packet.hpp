// A packet of rays: what is traced together, on every machine.
#pragma once

#include <cstdint>

namespace csgcore {

/// Rays in a packet, on every machine: nothing that bears results depends on the vectors' width.
constexpr uint32_t kPacketRays = 32;
/// Where a packet is a block of pixels, its sides. Lane = 8·row + column.
constexpr uint32_t kPacketWidth_px = 8;
constexpr uint32_t kPacketHeight_px = 4;
static_assert(kPacketWidth_px * kPacketHeight_px == kPacketRays);

using LaneMask = uint32_t;  // bit i: lane i
constexpr LaneMask kAllLanes = 0xFFFFFFFFu;

/// o, d and 1/d·d of each lane, in the units of the world, by coordinate.
struct alignas(64) RayPacket {
  double origin[3][kPacketRays];
  double direction[3][kPacketRays];
  double inverse_length2[kPacketRays];
};

}  // namespace csgcore
