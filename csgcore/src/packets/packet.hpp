// Traces packets of rays through Boolean lists. Tiles and kd cells share this evaluation.
#pragma once

#include <functional>

#include "packets/trace_list.hpp"
#include "rays/frame_rays.hpp"
#include "rays/ray_packet.hpp"

namespace csgcore {

/// The part of each ray in which hits are wanted: enter < t ≤ leave. It is divided at the planes of
/// a kd-tree.
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

/// Up to where first hits matter, by lane, at most the largest double: later ones may be left out,
/// and what is behind them.
struct alignas(64) PacketLimits {
  double last_t[kPacketRays];
};

/// Finds the hit of each lane in `lanes` along its whole ray. No limits: all first hits matter.
void trace_packet(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                  const TraceList& list, const TraceParameters& parameters,
                  const PacketLimits* limits, PacketWorkspace& workspace, PacketHits& hits);

/// Returns, of the first hits of a packet, the lanes whose boundary behind is wanted.
using GoesOn = std::function<LaneMask(const PacketHits& front)>;
/// Finds the first hits of whole rays, and what lies behind them on the lanes that `goes_on`
/// returns. Without a function these are all lanes, and the first hits are not resolved. The list
/// must be one for Boundary::kBehind, as parameters.boundary is.
void trace_packet_sides(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                        const TraceList& list, const TraceParameters& parameters,
                        const PacketLimits* limits, const GoesOn& goes_on,
                        PacketWorkspace& workspace, PacketHits& front, PacketHits& behind);

/// Does what trace_packet() does within a range. Before the first range of a packet,
/// workspace.segment_store must be cleared. `eye_inside` is the solid's value at the eye for the
/// lanes in `known`; for other lanes it is the value at range.enter. Lanes that the range alone
/// cannot decide are returned in hits.undecided.
void trace_packet_in_range(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                           const PacketRange& range, const TraceList& list,
                           const TraceParameters& parameters, LaneMask known, LaneMask eye_inside,
                           PacketWorkspace& workspace, PacketHits& hits);

}  // namespace csgcore
