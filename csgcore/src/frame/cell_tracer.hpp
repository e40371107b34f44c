// Traces a picture through the cells of a kd-tree, from front to back (paper §2.3), packet by
// packet.
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "csgcore/subdivision.hpp"
#include "packets/hit_sink.hpp"
#include "tiles/tile_tracer.hpp"

namespace csgcore {

/// The blocks of a tile of kTileSide_px a side, one above the other.
constexpr uint32_t kTileBlocks = kTileSide_px / kPacketHeight_px;

/// Traces one frame.
class CellTracer {
 public:
  /// The working memory of a task.
  class Workspace;

  /// Keeps references to all arguments but the parameters. `workspaces` is that of the tracer by
  /// tiles, for rays that cells cannot decide.
  CellTracer(const Subdivision& subdivision, const FrameRays& frame,
             const TraceParameters& parameters,
             std::shared_ptr<TileTracer::Workspaces> workspaces = nullptr);
  ~CellTracer();

  /// Traces the area's pixels through their centres, in parallel.
  void trace(const PixelArea& area, HitSink& sink);
  /// Traces the given lanes of the tile's blocks.
  void trace_tile(const Tile& tile, std::span<const LaneMask, kTileBlocks> lanes, HitSink& sink,
                  Workspace& workspace);

  /// Counts what trace() has done, and all that was done by tiles.
  TileTracer::Counts counts() const;

 private:
  class Traversal;

  void trace_by_tile(const Tile& tile, std::span<const LaneMask> undecided, HitSink& sink);
  TileTracer& tile_tracer();

  const Subdivision& subdivision_;
  const FrameRays& frame_;
  const TraceParameters parameters_;
  const std::shared_ptr<TileTracer::Workspaces> workspaces_;
  mutable std::mutex mutex_;
  TileTracer::Counts counts_;
  std::once_flag tile_tracer_made_;
  std::unique_ptr<TileTracer> tile_tracer_;
};

class CellTracer::Workspace {
 public:
  TileTracer::Counts counts() const;

 private:
  friend class CellTracer;
  /// A node that some lanes have yet to visit, and the ranges of their rays within its cell.
  struct Visit {
    uint32_t node;
    LaneMask lanes;
    PacketRange range;
  };
  std::vector<Visit> stack_;
  PacketWorkspace packets_;
  CellList list_;
  std::vector<double> nearest_;
  uint64_t rays_ = 0;
};

}  // namespace csgcore
