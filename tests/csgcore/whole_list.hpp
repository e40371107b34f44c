// Draws pictures without tiles, cells or any culling: every ray is traced with the solid's whole
// list, by the same evaluation.
#pragma once

#include <functional>

#include "csgcore/tracer.hpp"
#include "packets/packet.hpp"

namespace csgcore::checks {

/// Traces packets with the whole list of a solid.
class WholeList {
 public:
  /// The solid must outlive this object.
  WholeList(const Solid& solid, const View& view, Boundary boundary = Boundary::kFirst);

  const FrameRays& frame() const { return frame_; }
  /// The list that the indices of hits refer to.
  const TraceList& list() const { return list_; }
  PacketHits trace(const RayPacket& rays, LaneMask lanes);
  Hits picture();

 private:
  const FrameRays frame_;
  TraceParameters parameters_;
  std::vector<double> nearest_t_;
  TraceList list_;
  PacketWorkspace workspace_;
};

bool same_bits(const Hits& a, const Hits& b);
bool same_bits(const Image& a, const Image& b);

Hits trace_by_tiles(const Solid& solid, const View& view, const TraceOptions& options = {});
Hits trace_by_cells(const Subdivision& subdivision, const View& view,
                    const TraceOptions& options = {});

uint64_t count_hits(const Hits& hits);

}  // namespace csgcore::checks
