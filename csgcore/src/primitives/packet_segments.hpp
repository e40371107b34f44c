// The segments of a packet's rays within one primitive.
#pragma once

#include "rays/ray_packet.hpp"

namespace csgcore {

/// The parameters t at which the rays enter and leave a primitive: start < end, or +∞ and −∞ for a
/// ray that misses it. The masks are needed to find the normals at the ends: for a frustum they say
/// whether the end lies on a cap, for a polyhedron whether the ray leaves there.
struct alignas(64) PacketSegments {
  double start[kPacketRays];
  double end[kPacketRays];
  LaneMask start_on_cap = 0;
  LaneMask end_on_cap = 0;
  /// The lanes that may meet the primitive again behind `end`. It has a meaning only if the
  /// primitive is not convex.
  LaneMask more = 0;
};

}  // namespace csgcore
