// A packet of rays, which are traced together.
#pragma once

#include <bit>
#include <cstdint>

namespace csgcore {

/// The number of rays in a packet, on every machine: results must not depend on the vectors' width.
constexpr uint32_t kPacketRays = 32;
/// The sides of a packet that is a block of pixels. Its lane is 8·row + column.
constexpr uint32_t kPacketWidth_px = 8;
constexpr uint32_t kPacketHeight_px = 4;
static_assert(kPacketWidth_px * kPacketHeight_px == kPacketRays);

using LaneMask = uint32_t;  // bit i: lane i
constexpr LaneMask kAllLanes = 0xFFFFFFFFu;

/// Calls visit(lane) with each of the lanes.
template <typename Visit>
void for_each_lane(LaneMask lanes, Visit&& visit) {
  for (; lanes != 0; lanes &= lanes - 1) visit(static_cast<uint32_t>(std::countr_zero(lanes)));
}

/// Origin o, direction d and 1/(d·d) of each lane's ray, in world units, coordinate by coordinate.
struct alignas(64) RayPacket {
  double origin[3][kPacketRays];
  double direction[3][kPacketRays];
  double inverse_length2[kPacketRays];
};

}  // namespace csgcore
