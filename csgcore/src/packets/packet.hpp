// Traces packets of rays through Boolean lists. Tiles and kd cells share this evaluation.
#pragma once

#include "packets/ranges.hpp"
#include "packets/trace_list.hpp"
#include "rays/frame_rays.hpp"

namespace csgcore {

/// Finds the first hit of each lane in `lanes` along its whole ray.
void trace_packet(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                  const TraceList& list, const TraceParameters& parameters,
                  PacketWorkspace& workspace, PacketHits& hits);

/// Does the same within a range. Before the first range of a packet, workspace.segment_store must
/// be cleared. `eye_inside` is the solid's value at the eye for the lanes in `known`; for other
/// lanes it is the value at range.enter. Lanes that the range alone cannot decide are returned in
/// hits.undecided.
void trace_packet_in_range(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                           const PacketRange& range, const TraceList& list,
                           const TraceParameters& parameters, LaneMask known, LaneMask eye_inside,
                           PacketWorkspace& workspace, PacketHits& hits);

}  // namespace csgcore
