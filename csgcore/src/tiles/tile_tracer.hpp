// What the rays of each part of the screen can meet: the screen is divided like a kd-tree, and with
// it the solid's list, down to tiles of a few pixels.
#pragma once

#include <limits>
#include <memory>
#include <mutex>
#include <vector>

#include "csgcore/solid.hpp"
#include "packets/hit_sink.hpp"
#include "packets/packet.hpp"
#include "screen/screen_bounds.hpp"
#include "tiles/tile_list.hpp"

namespace csgcore {

/// A tile of so few pixels a side is traced by two packets, one above the other.
constexpr uint32_t kTileSide_px = 8;

/// A list with what tracing needs to know of it.
class TileList {
 public:
  void assign(std::span<const CanonicalPrimitive> primitives, const ScreenBounds& bounds,
              const Tile& tile, const CellList& list);
  /// For rays of any pixels of the tile.
  const TraceList& trace_list() const { return trace_; }
  /// For rays through the centres of the block's pixels, which is one of a tile of two.
  TraceList trace_list(const PacketBlock& block) const;

 private:
  static constexpr size_t kBlocks = 2;
  Tile tile_;
  std::vector<double> nearest_;
  std::vector<LaneMask> reached_[kBlocks];
  TraceList trace_;
};

/// Traces packets of one tile. Belongs to one thread.
class TileRays {
 public:
  virtual ~TileRays() = default;

  /// What the tile's rays can meet; for those who evaluate it themselves.
  struct Met {
    const CellList& list;
    /// All rays end before this depth, and the list is without what lies behind it. +∞: it is
    /// without nothing. Of lists that are cut by faces this is not known
    /// (TileRules::cuts_by_faces).
    double cut_t;
  };
  virtual Met met() = 0;

  /// Rays through any pixels of the tile. Returns the list that the hits' indices refer to.
  virtual const TraceList& trace(const RayPacket& rays, LaneMask lanes, PacketHits& hits) = 0;
  /// Those through the centres of a block's pixels.
  virtual const TraceList& trace(const RayPacket& rays, const PacketBlock& block,
                                 PacketHits& hits) = 0;
};

/// Traces the rays through the centres of a block's pixels, and stores what they hit.
void trace_block(const FrameRays& frame, const PacketBlock& block, TileRays& rays, HitSink& sink);

/// What is done with tiles. Called by all threads, for each pixel once.
class TileVisitor {
 public:
  virtual ~TileVisitor() = default;
  /// Whether any pixel of the tile matters; if not, it is not divided further.
  virtual bool wants(const Tile&) const { return true; }
  /// No ray of the tile meets anything.
  virtual void visit_empty(const Tile& tile) = 0;
  virtual void visit(const Tile& tile, TileRays& rays) = 0;
};

/// When a tile is divided no further, and what its list may be without. The defaults are the
/// tracer's.
struct TileRules {
  /// Rays go through pixels' centres only.
  bool centers_only = true;
  /// A tile of kTileSide_px is not divided if its list is this short.
  uint32_t tile_list = 48;
  /// Nor is one of a packet; one of 2 pixels a side in any case.
  uint32_t packet_list = std::numeric_limits<uint32_t>::max();
  /// What is hidden is left out where what hides it is, along every ray, longer than this share of
  /// its depth on the screen: who computes less exactly than the tracer must not miss it.
  double cover_share = 0;
  /// Whether it may be without what is hidden behind a face that all rays meet at depths of their
  /// own.
  bool cuts_by_faces = true;
};

/// One frame's tiles.
class TileTracer {
 public:
  struct Counts {
    uint64_t tiles = 0;
    uint64_t rays = 0;
    uint64_t intersections = 0;
    uint64_t resolved_rays = 0;
  };

  /// Keeps references to solid, frame and cull_reasons.
  TileTracer(const Solid& solid, const FrameRays& frame, const TraceParameters& parameters,
             const TileRules& rules, CullReasons& cull_reasons);
  ~TileTracer();

  /// All tiles of `area`, in parallel if that is more than a few.
  void visit(const Tile& area, TileVisitor& visitor);

  Counts counts() const;
  /// Adds to the cull_reasons what is known of the primitives' places on the screen.
  void note_screen_cull_reasons();

 private:
  struct Level;
  struct Workspace;
  class Lease;
  class LeafRays;

  /// What a list has lost of what is hidden.
  struct Cut {
    const CellList* fallback = nullptr;  // the list before; null: it is whole
    /// All rays end before this depth: TileRays::Met::cut_t, unless cut by a face.
    double t = std::numeric_limits<double>::infinity();
  };

  void divide(const Tile& tile, const CellList& list, Cut cut, size_t level, Workspace& workspace,
              TileVisitor& visitor);
  void visit_leaf(const Tile& tile, const CellList& list, const Cut& cut, Workspace& workspace,
                  TileVisitor& visitor);
  const CellList* cull(const Tile& tile, const CellList* list, bool is_new, bool is_cut,
                       Level& level, Workspace& workspace, bool& cuts);
  const CellList& open_groups(const Tile& tile, const CellList& list,
                              std::span<const uint8_t> marked, CellList (&buffers)[2],
                              Workspace& workspace);
  const CellList* open_large_groups(const Tile& tile, const CellList* list, double share,
                                    CellList (&buffers)[2], Workspace& workspace);
  Box box_of(const Tile& tile) const;

  const Solid& solid_;
  const OperandGroups& groups_;
  const FrameRays& frame_;
  const TraceParameters parameters_;
  const TileRules rules_;
  CullReasons& cull_reasons_;
  const std::optional<bool> last_value_;
  ScreenBounds bounds_;
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> workspaces_;
  std::vector<Workspace*> free_workspaces_;
};

}  // namespace csgcore
