// Where a packet's rays are within one primitive.
#pragma once

#include "rays/ray_packet.hpp"

namespace csgcore {

/// Where a primitive's surface cuts the rays: start < end in τ, or +∞ and −∞; and what the normal
/// there is asked for with: of a frustum, whether that end lies on a cap; of a polyhedron, whether
/// the ray leaves there.
struct alignas(64) PacketSegments {
  double start[kPacketRays];
  double end[kPacketRays];
  LaneMask start_on_cap = 0;
  LaneMask end_on_cap = 0;
};

}  // namespace csgcore
