// Parts of a packet's rays, divided at the planes of a kd-tree.
#pragma once

#include "rays/ray_packet.hpp"

namespace csgcore {

/// The part of each ray that a list is valid for: hits are wanted with enter < t ≤ leave.
struct alignas(64) PacketRange {
  double enter[kPacketRays];
  double leave[kPacketRays];
  double margin;  // the list is valid so far beyond, in world units
};

/// 1/d of each lane, +∞ for 0, by coordinate.
struct alignas(64) PacketInverses {
  double inverse[3][kPacketRays];
};
void invert_directions(const RayPacket& rays, PacketInverses& inverses);

/// The lanes that go on before and beyond a plane.
struct RangeSplit {
  LaneMask before, beyond;
};
/// Divides ranges at the plane where the coordinate, from the pivot, is `plane`: `range` becomes
/// their parts before it, `far` those beyond it, in the rays' order, which must be the same for all
/// lanes that matter. A ray along the plane is on one side of it for ever.
RangeSplit split_range(const RayPacket& rays, const PacketInverses& inverses, int axis,
                       double plane, PacketRange& range, PacketRange& far);

}  // namespace csgcore
