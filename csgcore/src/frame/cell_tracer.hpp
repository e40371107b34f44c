// Traces a picture through the cells of a kd-tree, from front to back (paper §2.3), packet by
// packet.
#pragma once

#include <memory>
#include <mutex>

#include "csgcore/subdivision.hpp"
#include "packets/hit_sink.hpp"
#include "tiles/tile_tracer.hpp"

namespace csgcore {

/// Traces one frame.
class CellTracer {
 public:
  /// Keeps references to all arguments but the parameters.
  CellTracer(const Subdivision& subdivision, const FrameRays& frame,
             const TraceParameters& parameters, HitSink& sink);
  ~CellTracer();

  /// Traces the area's pixels through their centres, in parallel.
  void trace(const PixelArea& area);

  TileTracer::Counts counts() const;

 private:
  struct Workspace;
  class Traversal;

  void trace_tile(const Tile& tile, Workspace& workspace);
  void trace_by_tile(const Tile& tile, std::span<const LaneMask> undecided);
  TileTracer& tile_tracer();

  const Subdivision& subdivision_;
  const FrameRays& frame_;
  const TraceParameters parameters_;
  HitSink& sink_;
  mutable std::mutex mutex_;
  TileTracer::Counts counts_;
  std::once_flag tile_tracer_made_;
  std::unique_ptr<TileTracer> tile_tracer_;
};

}  // namespace csgcore
