// Traces packets of rays through lists: the evaluation that tiles and kd cells share.
#pragma once

#include "packets/ranges.hpp"
#include "packets/trace_list.hpp"
#include "rays/frame_rays.hpp"

namespace csgcore {

/// The first hit of each lane in `lanes` along its whole ray.
void trace_packet(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                  const TraceList& list, const TraceParameters& parameters,
                  PacketWorkspace& workspace, PacketHits& hits);

/// The same within a range. `eye_inside`: the solid's value at the eye, of the lanes in `known`;
/// that of others is the value at their `enter`. Lanes that the range alone cannot decide come back
/// as undecided.
void trace_packet_in_range(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                           const PacketRange& range, const TraceList& list,
                           const TraceParameters& parameters, LaneMask known, LaneMask eye_inside,
                           PacketWorkspace& workspace, PacketHits& hits);

}  // namespace csgcore
