// The screen is divided into regions, which are drawn in parallel; each takes the surfaces in their
// turn. A surface is traced in those tiles and packets only in which its receiver may show it.
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

#include "base/worker_threads.hpp"
#include "csgcore/surfaces.hpp"
#include "frame/cell_tracer.hpp"
#include "packets/hit_sink.hpp"
#include "packets/shading.hpp"
#include "rays/packet_blocks.hpp"
#include "screen/screen_extents.hpp"
#include "tiles/tile_tracer.hpp"

namespace csgcore {
namespace {

using Clock = std::chrono::steady_clock;

/// The side of the squares of pixels that tasks draw. Squares of this size TileTracer makes no
/// tasks of.
constexpr uint32_t kRegionSide_px = 64;
constexpr uint32_t kSquaresAlong = kRegionSide_px / kSurfaceSquare_px;
constexpr uint32_t kSquares = kSquaresAlong * kSquaresAlong;
static_assert(kSurfaceSquare_px == kTileSide_px);
static_assert(PixelBlock::kWidth_px == kPacketWidth_px);
static_assert(PixelBlock::kHeight_px == kPacketHeight_px);

constexpr uint32_t kNoSlot = std::numeric_limits<uint32_t>::max();

/// Returns the area with its sides moved outwards to those of squares, as far as the picture goes.
PixelArea whole_squares(const PixelArea& area, const View& view) {
  const auto down = [](uint32_t x) { return x / kSurfaceSquare_px * kSurfaceSquare_px; };
  const auto up = [&](uint32_t x) { return down(x + kSurfaceSquare_px - 1); };
  const uint32_t left = down(area.x), top = down(area.y);
  return {left, top, std::min(up(area.x + area.width), view.width_px) - left,
          std::min(up(area.y + area.height), view.height_px) - top};
}

/// Calls visit(square) for each square of an area whose left and top sides are squares'.
template <typename Visit>
void for_each_square(const Tile& area, Visit&& visit) {
  for (uint32_t y = 0; y < area.height; y += kSurfaceSquare_px) {
    for (uint32_t x = 0; x < area.width; x += kSurfaceSquare_px) {
      visit(Tile{area.x + x, area.y + y, std::min(kSurfaceSquare_px, area.width - x),
                 std::min(kSurfaceSquare_px, area.height - y)});
    }
  }
}

/// A surface, and what is known of it before any ray is traced.
struct PlacedSurface {
  const Surface* surface = nullptr;
  FrameRays rays;
  TraceParameters parameters;
  PixelArea area;  // in whole squares; outside of it the surface is not seen
  float nearest_z = 0;
  ShadeSettings shade;
  uint32_t turns = 0;
  uint32_t number = kNoSlot;  // among those of several turns

  // Made when it is first traced: most surfaces of a picture of many are hidden.
  std::once_flag is_made;
  std::unique_ptr<TileTracer> tiles;
  std::unique_ptr<CellTracer> cells;
};

/// What a square shows of a surface.
struct KeptSquare {
  LaneMask hits[kTileBlocks] = {};  // by block from the top
  float nearest_z = std::numeric_limits<float>::infinity();
  SurfacePixels blocks[kTileBlocks];
};

/// What a region shows of a surface of several turns, which is traced once.
struct KeptSurface {
  KeptSquare* squares[kSquares] = {};  // null: no pixel is hit, or it is not known
  enum State : uint8_t { kUnknown, kWanted, kKnown };
  State states[kSquares] = {};
};

/// The turns that are drawn at once.
struct Step {
  uint32_t turn;
  uint32_t surface;
  /// This turn is that of a solid's kBehind, and the next one of the same solid's kFirst.
  bool has_both;
};

class SurfaceTracer {
 public:
  SurfaceTracer(std::span<const Surface> surfaces, std::span<const uint32_t> turns,
                const View& view, const TraceOptions& options, SurfaceSink& sink)
      : surfaces_(surfaces),
        turns_(turns),
        view_(view),
        options_(options),
        sink_(sink),
        count_(surfaces.size()),
        placed_(std::make_unique<PlacedSurface[]>(surfaces.size())),
        workspaces_(std::make_shared<TileTracer::Workspaces>()) {}

  /// Finds out where the surfaces are.
  void place() {
    const FrameRays frame = frame_rays(view_, {});
    tbb::parallel_for(size_t{0}, count_, [&](size_t i) { place(frame, surfaces_[i], placed_[i]); });
    for (const uint32_t surface : turns_) ++placed_[surface].turns;
    for (PlacedSurface& placed : std::span(placed_.get(), count_)) {
      if (placed.turns > 1) placed.number = kept_surfaces_++;
    }
    for (uint32_t turn = 0; turn < turns_.size(); ++turn) {
      const bool has_both = turn + 1 < turns_.size() && are_sides(turns_[turn], turns_[turn + 1]);
      if (!placed_[turns_[turn]].area.empty()) steps_.push_back({turn, turns_[turn], has_both});
      if (has_both) ++turn;
    }
  }

  void trace();

  TileTracer::Counts counts() const {
    TileTracer::Counts sum = workspaces_->counts();
    sum += counts_;
    return sum;
  }

 private:
  class Region;
  class Shown;
  class Kept;

  void place(const FrameRays& frame, const Surface& surface, PlacedSurface& placed) const {
    const Box& bounds = surface.solid->bounds();
    placed.surface = &surface;
    if (bounds.empty()) return;
    placed.rays = rebased(frame, bounds);
    const Extent screen = screen_extent_of(bounds, placed.rays, {});
    const PixelArea area = pixels_of(screen, view_);
    if (area.empty()) return;
    placed.area = whole_squares(area, view_);
    placed.nearest_z = static_cast<float>(placed.rays.base_s + nearest_t(screen));
    placed.parameters.thickness_tolerance =
        options_.thickness_tolerance.value_or(thickness_tolerance(bounds));
    placed.parameters.boundary = surface.boundary;
    placed.parameters.stop = options_.stop;
    placed.shade = shade_settings(surface.frame, view_, bounds);
  }

  /// Returns whether the two are a solid's far and near side, to be traced at once.
  bool are_sides(uint32_t behind, uint32_t first) const {
    const PlacedSurface& a = placed_[behind];
    const PlacedSurface& b = placed_[first];
    return a.surface->boundary == Boundary::kBehind && b.surface->boundary == Boundary::kFirst &&
           a.surface->solid == b.surface->solid && !a.surface->subdivision &&
           !b.surface->subdivision && a.turns == 1 && b.turns == 1;
  }

  void make(PlacedSurface& placed) {
    std::call_once(placed.is_made, [&] {
      // A thread that waits for others must not take a task which waits for this call.
      tbb::this_task_arena::isolate([&] {
        const Surface& surface = *placed.surface;
        if (surface.subdivision) {
          placed.cells = std::make_unique<CellTracer>(*surface.subdivision, placed.rays,
                                                      placed.parameters, workspaces_);
        } else {
          placed.tiles = std::make_unique<TileTracer>(*surface.solid, placed.rays,
                                                      placed.parameters, TileRules{}, workspaces_);
        }
      });
    });
  }

  const std::span<const Surface> surfaces_;
  const std::span<const uint32_t> turns_;
  const View& view_;
  const TraceOptions& options_;
  SurfaceSink& sink_;
  const size_t count_;
  const std::unique_ptr<PlacedSurface[]> placed_;
  uint32_t kept_surfaces_ = 0;
  std::vector<Step> steps_;
  const std::shared_ptr<TileTracer::Workspaces> workspaces_;
  std::mutex mutex_;
  TileTracer::Counts counts_;  // of cells
};

/// Shades what hits show. `rays` and `hits` belong to each other.
void shade_pixels(const PlacedSurface& placed, const RayPacket& rays, const TraceList& list,
                  const PacketHits& hits, SurfacePixels& pixels) {
  PacketColors colors;
  shade_packet(placed.shade, placed.rays, rays, list, hits, colors);
  PacketPixels rounded;
  round_colors(colors, hits.hits, {}, rounded);
  std::copy_n(rounded.rgb, kPacketRays, pixels.rgb);
  for_each_lane(hits.hits, [&](uint32_t lane) {
    pixels.id[lane] = list.primitives[list.list->primitive[hits.index[lane]] & kPrimitiveBits].id;
  });
}

void find_depths(const PlacedSurface& placed, const PacketHits& hits,
                 float (&z)[PixelBlock::kPixels]) {
  for_each_lane(hits.hits, [&](uint32_t lane) {
    z[lane] = static_cast<float>(placed.rays.base_s + hits.t[lane]);
  });
}

/// Draws a part of the screen, in one thread.
class SurfaceTracer::Region {
 public:
  Region(SurfaceTracer& owner, const Tile& region)
      : owner_(owner), region_(region), slots_(owner.kept_surfaces_, kNoSlot) {}

  ~Region() {
    const std::lock_guard lock(owner_.mutex_);
    owner_.counts_ += cells_.counts();
  }

  void draw(const Step& step) {
    PlacedSurface& placed = owner_.placed_[step.surface];
    const Tile area = intersection(region_, placed.area);
    if (area.empty()) return;
    if (placed.number != kNoSlot) return draw_kept(step.turn, placed, area);
    const uint32_t asked = step.has_both ? step.turn + 1 : step.turn;
    if (owner_.sink_.wants(asked, area, placed.nearest_z)) draw(step, placed, area);
  }

  size_t index_of(const Tile& tile) const {
    return (tile.y - region_.y) / kSurfaceSquare_px * kSquaresAlong +
           (tile.x - region_.x) / kSurfaceSquare_px;
  }
  /// Returns the kept square that holds the tile.
  KeptSquare& kept_square(KeptSurface& kept, const Tile& tile) {
    KeptSquare*& square = kept.squares[index_of(tile)];
    if (!square) square = squares_.emplace_back(std::make_unique<KeptSquare>()).get();
    return *square;
  }

 private:
  void draw(const Step& step, PlacedSurface& placed, const Tile& area);
  void draw_kept(uint32_t turn, PlacedSurface& placed, const Tile& area);
  void trace_kept(PlacedSurface& placed, KeptSurface& kept, const Tile& area);
  KeptSurface& kept_of(const PlacedSurface& placed) {
    uint32_t& slot = slots_[placed.number];
    if (slot == kNoSlot) {
      slot = static_cast<uint32_t>(kept_.size());
      kept_.push_back(std::make_unique<KeptSurface>());
    }
    return *kept_[slot];
  }

  SurfaceTracer& owner_;
  const Tile region_;
  CellTracer::Workspace cells_;
  std::vector<uint32_t> slots_;  // by number of a surface of several turns: its place in kept_
  std::vector<std::unique_ptr<KeptSurface>> kept_;
  std::vector<std::unique_ptr<KeptSquare>> squares_;
};

/// Traces a surface where its turn may show it, and passes on what does.
class SurfaceTracer::Shown final : public TileVisitor, public HitSink {
 public:
  /// `front` is that of a step that has both sides, else null.
  Shown(SurfaceSink& sink, const PlacedSurface& placed, const Step& step,
        const PlacedSurface* front)
      : sink_(sink),
        placed_(placed),
        front_(front),
        turn_(step.turn),
        asked_(front ? step.turn + 1 : step.turn) {}

  bool wants(const Tile& tile) const override {
    return sink_.wants(asked_, tile, placed_.nearest_z);
  }

  void visit_empty(const Tile&) override {}

  void visit(const Tile& tile, TileRays& rays) override {
    const auto nearest_z = static_cast<float>(placed_.rays.base_s + rays.nearest_t());
    if (!sink_.wants(asked_, tile, nearest_z)) return;
    for_each_block(tile, [&](PacketBlock block) {
      PacketLimits limits;
      block.lanes = wanted(block, nearest_z, limits);
      if (block.lanes == 0) return;
      if (front_) return draw_both(block, limits, rays);
      trace_block(placed_.rays, block, &limits, rays, *this);
    });
  }

  LaneMask wanted(const PacketBlock& block, float nearest_z, PacketLimits& limits) const {
    const PixelBlock pixels{block.x, block.y, block.lanes};
    const LaneMask lanes = sink_.wanted(asked_, pixels, nearest_z, limits.last_t);
    constexpr double kEndless = std::numeric_limits<double>::max();
    for (double& last : limits.last_t) last = std::min(last - placed_.rays.base_s, kEndless);
    return lanes;
  }

  void clear(const Tile&) override {}

  void store(const PacketBlock& block, const RayPacket& rays, const TraceList& list,
             const PacketHits& hits) override {
    draw(turn_, placed_, block, rays, list, hits);
  }

 private:
  void draw_both(const PacketBlock& block, const PacketLimits& limits, TileRays& rays) {
    RayPacket packet;
    make_block_rays(placed_.rays, block, packet);
    PacketHits front, behind;
    const GoesOn goes_on = [&](const PacketHits& hits) {
      float z[PixelBlock::kPixels] = {};
      find_depths(*front_, hits, z);
      return sink_.shown(asked_, {block.x, block.y, hits.hits & block.lanes}, z);
    };
    const TraceList& list = rays.trace_sides(packet, block, &limits, goes_on, front, behind);
    draw(turn_, placed_, block, packet, list, behind);
    draw(asked_, *front_, block, packet, list, front);
  }

  void draw(uint32_t turn, const PlacedSurface& placed, const PacketBlock& block,
            const RayPacket& rays, const TraceList& list, const PacketHits& hits) {
    if ((hits.hits & block.lanes) == 0) return;
    SurfacePixels pixels{};
    find_depths(placed, hits, pixels.z);
    const PixelBlock shown{
        block.x, block.y, sink_.shown(turn, {block.x, block.y, hits.hits & block.lanes}, pixels.z)};
    if (shown.pixels == 0) return;
    shade_pixels(placed, rays, list, hits, pixels);
    sink_.draw(turn, shown, pixels);
  }

  SurfaceSink& sink_;
  const PlacedSurface& placed_;
  const PlacedSurface* const front_;
  const uint32_t turn_, asked_;
};

/// Traces squares of a surface of several turns, and keeps what they show.
class SurfaceTracer::Kept final : public TileVisitor, public HitSink {
 public:
  Kept(Region& region, const PlacedSurface& placed, KeptSurface& kept)
      : region_(region), placed_(placed), kept_(kept) {}

  bool wants(const Tile& tile) const override {
    bool any = false;
    for_each_square(tile, [&](const Tile& square) {
      any = any || kept_.states[region_.index_of(square)] == KeptSurface::kWanted;
    });
    return any;
  }
  void visit_empty(const Tile&) override {}
  void visit(const Tile& tile, TileRays& rays) override {
    for_each_block(
        tile, [&](const PacketBlock& block) { trace_block(placed_.rays, block, rays, *this); });
  }

  void clear(const Tile&) override {}

  void store(const PacketBlock& block, const RayPacket& rays, const TraceList& list,
             const PacketHits& hits) override {
    const LaneMask lanes = hits.hits & block.lanes;
    if (lanes == 0) return;
    SurfacePixels pixels{};
    find_depths(placed_, hits, pixels.z);
    shade_pixels(placed_, rays, list, hits, pixels);
    KeptSquare& square = region_.kept_square(kept_, {block.x, block.y, 1, 1});
    for_each_lane(lanes, [&](uint32_t lane) {
      const uint32_t x = (block.x + lane % kPacketWidth_px) % kSurfaceSquare_px;
      const uint32_t y = (block.y + lane / kPacketWidth_px) % kSurfaceSquare_px;
      const uint32_t pixel = x + kSurfaceSquare_px * y;
      SurfacePixels& to = square.blocks[pixel / kPacketRays];
      to.z[pixel % kPacketRays] = pixels.z[lane];
      to.rgb[pixel % kPacketRays] = pixels.rgb[lane];
      to.id[pixel % kPacketRays] = pixels.id[lane];
      square.hits[pixel / kPacketRays] |= LaneMask{1} << pixel % kPacketRays;
      square.nearest_z = std::min(square.nearest_z, pixels.z[lane]);
    });
  }

 private:
  Region& region_;
  const PlacedSurface& placed_;
  KeptSurface& kept_;
};

void SurfaceTracer::Region::draw(const Step& step, PlacedSurface& placed, const Tile& area) {
  owner_.make(placed);
  const PlacedSurface* const front =
      step.has_both ? &owner_.placed_[owner_.turns_[step.turn + 1]] : nullptr;
  Shown shown(owner_.sink_, placed, step, front);
  if (placed.tiles) {
    placed.tiles->visit(area, shown);
    return;
  }
  for_each_square(area, [&](const Tile& square) {
    if (!shown.wants(square)) return;
    LaneMask lanes[kTileBlocks] = {};
    for_each_block(square, [&](const PacketBlock& block) {
      PacketLimits limits;
      lanes[(block.y - square.y) / kPacketHeight_px] =
          shown.wanted(block, placed.nearest_z, limits);
    });
    placed.cells->trace_tile(square, lanes, shown, cells_);
  });
}

void SurfaceTracer::Region::draw_kept(uint32_t turn, PlacedSurface& placed, const Tile& area) {
  const SurfaceSink& sink = owner_.sink_;
  KeptSurface& kept = kept_of(placed);
  bool any_wanted = false;
  for_each_square(area, [&](const Tile& square) {
    KeptSurface::State& state = kept.states[index_of(square)];
    if (state == KeptSurface::kKnown || !sink.wants(turn, square, placed.nearest_z)) return;
    for_each_block(square, [&](const PacketBlock& block) {
      double furthest_z[kPacketRays];
      const PixelBlock pixels{block.x, block.y, block.lanes};
      if (sink.wanted(turn, pixels, placed.nearest_z, furthest_z) == 0) return;
      state = KeptSurface::kWanted;
      any_wanted = true;
    });
  });
  if (any_wanted) trace_kept(placed, kept, area);
  for_each_square(area, [&](const Tile& tile) {
    const KeptSquare* const square = kept.squares[index_of(tile)];
    if (!square || !sink.wants(turn, tile, square->nearest_z)) return;
    for (uint32_t i = 0; i < kTileBlocks; ++i) {
      const SurfacePixels& pixels = square->blocks[i];
      PixelBlock block{tile.x, tile.y + i * kPacketHeight_px, square->hits[i]};
      block.pixels = sink.shown(turn, block, pixels.z);
      if (block.pixels != 0) owner_.sink_.draw(turn, block, pixels);
    }
  });
}

/// Traces the wanted squares, all pixels of them.
void SurfaceTracer::Region::trace_kept(PlacedSurface& placed, KeptSurface& kept, const Tile& area) {
  owner_.make(placed);
  Kept visitor(*this, placed, kept);
  if (placed.tiles) placed.tiles->visit(area, visitor);
  for_each_square(area, [&](const Tile& square) {
    KeptSurface::State& state = kept.states[index_of(square)];
    if (state != KeptSurface::kWanted) return;
    constexpr LaneMask kAll[] = {kAllLanes, kAllLanes};
    if (placed.cells) placed.cells->trace_tile(square, kAll, visitor, cells_);
    state = KeptSurface::kKnown;
  });
}

void SurfaceTracer::trace() {
  const uint32_t columns = (view_.width_px + kRegionSide_px - 1) / kRegionSide_px;
  const uint32_t rows = (view_.height_px + kRegionSide_px - 1) / kRegionSide_px;
  tbb::parallel_for(uint32_t{0}, columns * rows, [&](uint32_t task) {
    const uint32_t x = task % columns * kRegionSide_px, y = task / columns * kRegionSide_px;
    const Tile area{x, y, std::min(kRegionSide_px, view_.width_px - x),
                    std::min(kRegionSide_px, view_.height_px - y)};
    Region region(*this, area);
    for (const Step& step : steps_) {
      if (options_.stop.stop_requested()) return;
      region.draw(step);
    }
    sink_.end(area);
  });
}

}  // namespace

void draw_surfaces(std::span<const Surface> surfaces, std::span<const uint32_t> turns,
                   const View& view, const TraceOptions& options, SurfaceSink& sink,
                   TraceStats& stats) {
  stats = {};
  with_threads(options.threads, [&] {
    const Clock::time_point start = Clock::now();
    SurfaceTracer tracer(surfaces, turns, view, options, sink);
    tracer.place();
    const Clock::time_point placed = Clock::now();
    tracer.trace();
    const auto ms = [](Clock::duration d) {
      return std::chrono::duration<double, std::milli>(d).count();
    };
    stats.cull_ms = ms(placed - start);
    stats.trace_ms = ms(Clock::now() - placed);
    const TileTracer::Counts counts = tracer.counts();
    const bool has_cells = std::ranges::any_of(
        surfaces, [](const Surface& surface) { return surface.subdivision != nullptr; });
    stats.tiles = has_cells ? 0 : counts.tiles;
    stats.rays = counts.rays;
    stats.intersections = counts.intersections;
    stats.resolved_rays = counts.resolved_rays;
  });
}

}  // namespace csgcore
