// Ranges of a packet's rays, which are divided at the planes of a kd-tree.
#pragma once

#include "rays/ray_packet.hpp"

namespace csgcore {

/// The part of each ray in which hits are wanted: enter < t ≤ leave.
struct alignas(64) PacketRange {
  double enter[kPacketRays];
  double leave[kPacketRays];
  double margin;  // the cell's list is valid so far beyond the cell, in world units
};

/// 1/d of each lane, coordinate by coordinate; +∞ where d is 0.
struct alignas(64) PacketInverses {
  double inverse[3][kPacketRays];
};
void invert_directions(const RayPacket& rays, PacketInverses& inverses);

/// The lanes with a part before and with a part beyond a plane.
struct RangeSplit {
  LaneMask before, beyond;
};
/// Divides ranges at a plane across `axis`; `plane` is its coordinate relative to the pivot.
/// `range` becomes the parts before the plane, `far` the parts beyond it, in the order along the
/// rays, which must be the same for all lanes that matter. A ray parallel to the plane lies on one
/// side of it throughout.
RangeSplit split_range(const RayPacket& rays, const PacketInverses& inverses, int axis,
                       double plane, PacketRange& range, PacketRange& far);

}  // namespace csgcore
