// Divides the screen like a kd-tree, down to tiles of a few pixels, and restricts the solid's list
// to each tile on the way: the result is what the tile's rays can meet.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "base/pool.hpp"
#include "csgcore/solid.hpp"
#include "packets/hit_sink.hpp"
#include "packets/packet.hpp"
#include "screen/screen_bounds.hpp"
#include "tiles/tile_list.hpp"

namespace csgcore {

/// A tile of this side is traced by two packets, one above the other.
constexpr uint32_t kTileSide_px = 8;

/// A tile's list with the facts about its tests that tracing uses.
class TileList {
 public:
  void assign(std::span<const CanonicalPrimitive> primitives, const ScreenBounds& bounds,
              const Tile& tile, const CellList& list);
  /// For rays through any points of the tile.
  const TraceList& trace_list() const { return trace_; }
  /// For rays through the centres of the pixels of a block of the tile.
  TraceList trace_list(const PacketBlock& block) const;

 private:
  static constexpr size_t kBlocks = 2;
  Tile tile_;
  std::vector<double> nearest_;
  std::vector<LaneMask> reached_[kBlocks];
  TraceList trace_;
};

/// Traces packets of one tile, in one thread.
class TileRays {
 public:
  virtual ~TileRays() = default;

  /// What the tile's rays can meet, for callers that evaluate the list themselves.
  struct Met {
    const CellList& list;
    /// All rays end before this t, and the list may lack primitives behind it. +∞: it lacks none.
    /// It has no meaning if lists are cut by faces (TileRules::cuts_by_faces).
    double cut_t;
  };
  virtual Met met() = 0;

  /// Traces rays through any points of the tile, with trace_packet()'s limits. Returns the list
  /// that the hits' indices refer to.
  virtual const TraceList& trace(const RayPacket& rays, LaneMask lanes, const PacketLimits* limits,
                                 PacketHits& hits) = 0;
  /// Traces rays through the centres of a block's pixels, with trace_packet()'s limits.
  virtual const TraceList& trace(const RayPacket& rays, const PacketBlock& block,
                                 const PacketLimits* limits, PacketHits& hits) = 0;
  /// Does what trace_packet_sides() does, for such rays and a tracer for Boundary::kBehind.
  virtual const TraceList& trace_sides(const RayPacket& rays, const PacketBlock& block,
                                       const PacketLimits* limits, const GoesOn& goes_on,
                                       PacketHits& front, PacketHits& behind) = 0;
  /// No ray of the tile meets anything before this t.
  virtual double nearest_t() const = 0;
};

/// Traces the rays through the centres of a block's pixels, and stores what they hit.
void trace_block(const FrameRays& frame, const PacketBlock& block, const PacketLimits* limits,
                 TileRays& rays, HitSink& sink);
inline void trace_block(const FrameRays& frame, const PacketBlock& block, TileRays& rays,
                        HitSink& sink) {
  trace_block(frame, block, nullptr, rays, sink);
}

/// Receives the tiles of an area. All threads call it; each pixel is in one tile.
class TileVisitor {
 public:
  virtual ~TileVisitor() = default;
  /// Returns whether any pixel of the tile matters. If not, the tile is skipped.
  virtual bool wants(const Tile&) const { return true; }
  /// Is called for a tile whose rays meet nothing.
  virtual void visit_empty(const Tile& tile) = 0;
  virtual void visit(const Tile& tile, TileRays& rays) = 0;
};

/// The rules that end the division of tiles, and that say what their lists may lack. The defaults
/// are the CPU tracer's.
struct TileRules {
  /// True: rays go through pixels' centres only. False: through any points of pixels.
  bool centers_only = true;
  /// A tile of at most kTileSide_px a side is not divided if its list has at most so many tests.
  uint32_t tile_list = 48;
  /// A tile of at most one packet is not divided if its list has at most so many tests. Tiles of 2
  /// pixels a side are never divided.
  uint32_t packet_list = std::numeric_limits<uint32_t>::max();
  /// A primitive counts as an occluder only if it is, along every ray, thicker than this share of
  /// its depth on the screen. So a renderer that is less exact than the tracer does not miss it.
  double cover_share = 0;
  /// Whether a list may be cut by a face (TileCuller::cut_by_face).
  bool cuts_by_faces = true;
};

/// Makes the tiles of one frame.
class TileTracer {
 public:
  struct Counts {
    uint64_t tiles = 0;
    uint64_t rays = 0;
    uint64_t intersections = 0;
    uint64_t resolved_rays = 0;
    Counts& operator+=(const Counts& other);
  };

  /// The working memory of tracers, which may share it.
  class Workspaces;

  /// Keeps references to solid and frame. No `workspaces`: it has its own.
  TileTracer(const Solid& solid, const FrameRays& frame, const TraceParameters& parameters,
             const TileRules& rules, std::shared_ptr<Workspaces> workspaces = nullptr);
  ~TileTracer();

  /// Visits all tiles of `area`, in parallel unless they are few.
  void visit(const Tile& area, TileVisitor& visitor);

  /// Counts what all tracers have done that share the working memory.
  Counts counts() const;

 private:
  struct Level;
  struct Workspace;
  class Lease;
  class LeafRays;

  /// What a list has lost because it is hidden.
  struct Cut {
    const CellList* fallback = nullptr;  // the list before it was cut; null: it was not
    /// All rays end before this t: TileRays::Met::cut_t.
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
  TileCuller::Parameters cull_parameters() const;

  const Solid& solid_;
  const OperandGroups& groups_;
  const FrameRays& frame_;
  const TraceParameters parameters_;
  const TileRules rules_;
  const std::optional<bool> last_value_;
  ScreenBounds bounds_;
  const std::shared_ptr<Workspaces> workspaces_;
};

class TileTracer::Workspaces {
 public:
  Workspaces();
  ~Workspaces();
  Counts counts() const;

 private:
  friend class Lease;
  Pool<Workspace> pool_;
};

inline TileTracer::Counts TileTracer::counts() const { return workspaces_->counts(); }

}  // namespace csgcore
