#include "csgcore/tracer.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "hit_sink.hpp"
#include "tile_tracer.hpp"

namespace csgcore {
namespace {

/// Thinnest piece over the diagonal of the solid's box: NUMERICS.md says why.
constexpr double kThinnestPiece = 1e-9;

using Clock = std::chrono::steady_clock;

class Stopwatch {
 public:
  double lap_ms() {
    const Clock::time_point now = Clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return ms;
  }

 private:
  Clock::time_point last_ = Clock::now();
};

/// Runs with as many threads as are wanted.
template <typename Work>
void with_threads(unsigned threads, Work&& work) {
  if (threads == 0) {
    work();
    return;
  }
  // TBB warns on stderr where an arena asks for more threads than the process is allowed.
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena arena(static_cast<int>(threads));
  arena.execute(work);
}

TraceSubject subject_of(const Solid& solid, const View& view, const TraceOptions& options) {
  TraceSubject subject;
  subject.thinnest_piece = thinnest_piece(solid.bounds());
  subject.eye_inside =
      view.projection == Projection::kPerspective && solid.contains(view.eye);
  subject.boundary = options.boundary;
  return subject;
}

/// Each pixel through its centre.
class PixelVisitor final : public TileVisitor {
 public:
  PixelVisitor(const FrameRays& frame, HitSink& sink) : frame_(frame), sink_(sink) {}

  void visit_empty(const Tile& tile) override { sink_.clear(tile); }

  void visit(const Tile& tile, TileRays& rays) override {
    for (uint32_t y = 0; y < tile.height; y += kPacketSide_px) {
      for (uint32_t x = 0; x < tile.width; x += kPacketSide_px) {
        const LaneMask lanes = lanes_within(tile.width - x, tile.height - y);
        trace_block({tile.x + x, tile.y + y, lanes}, rays);
      }
    }
  }

 private:
  static LaneMask lanes_within(uint32_t width, uint32_t height) {
    if (width >= kPacketSide_px && height >= kPacketSide_px) return kAllLanes;
    LaneMask lanes = 0;
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      const bool within = lane % kPacketSide_px < width && lane / kPacketSide_px < height;
      lanes |= LaneMask{within} << lane;
    }
    return lanes;
  }

  void trace_block(const PacketBlock& block, TileRays& rays) {
    PacketPixels pixels;
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      pixels.x[lane] = block.x + lane % kPacketSide_px;
      pixels.y[lane] = block.y + lane / kPacketSide_px;
    }
    RayPacket packet;
    make_rays(frame_, pixels, packet);
    PacketHits hits;
    const TraceList& list = rays.trace(packet, block.lanes, hits);
    sink_.store(block, packet, list, hits);
  }

  const FrameRays& frame_;
  HitSink& sink_;
};

void count_fates(const Solid& solid, const Fates& fates, TraceStats& stats) {
  std::vector<bool> seen(solid.primitives().size());
  for (const Literal& literal : solid.list().literals) {
    if (seen[literal.primitive]) continue;
    seen[literal.primitive] = true;
    switch (static_cast<Fate>(fates.all()[literal.primitive])) {
      case Fate::kIntersected:
        ++stats.intersected;
        break;
      case Fate::kOffScreen:
        ++stats.skipped.off_screen;
        break;
      case Fate::kSubPixel:
        ++stats.skipped.sub_pixel;
        break;
      case Fate::kHidden:
        ++stats.skipped.hidden;
        break;
      case Fate::kInside:
        ++stats.skipped.inside;
        break;
      case Fate::kUnknown:
      case Fate::kCancelled:
        ++stats.skipped.cancelled;
        break;
    }
  }
}

void trace_tiles(const Solid& solid, const FrameRays& frame, const TraceSubject& subject,
                 const TraceOptions& options, HitSink& sink, TraceStats& stats) {
  stats = {};
  Fates fates;
  if (options.count_skipped) fates.resize(solid.primitives().size());
  with_threads(options.threads, [&] {
    Stopwatch watch;
    TileTracer tracer(solid, frame, subject, true, fates);
    stats.cull_ms = watch.lap_ms();
    PixelVisitor visitor(frame, sink);
    tracer.visit(tracer.whole_picture(), visitor);
    const TileTracer::Counts counts = tracer.counts();
    stats.tiles = counts.tiles;
    stats.intersections = counts.intersections;
    stats.resolved_rays = counts.resolved_rays;
    if (options.count_skipped) {
      tracer.note_screen_fates();
      count_fates(solid, fates, stats);
    }
    stats.trace_ms = watch.lap_ms();
  });
}

}  // namespace

double thinnest_piece(const Box& solid_bounds) { return kThinnestPiece * solid_bounds.diagonal(); }

void draw(const Solid& solid, const View& view, const FrameSettings& settings,
          const TraceOptions& options, Image& image, TraceStats& stats) {
  const FrameRays frame = frame_rays(view, solid.bounds());
  const TraceSubject subject = subject_of(solid, view, options);
  ImageSink sink(frame, settings, solid.bounds(), subject.eye_inside, image);
  trace_tiles(solid, frame, subject, options, sink, stats);
}

void trace(const Solid& solid, const View& view, const TraceOptions& options, Hits& hits,
           TraceStats& stats) {
  const FrameRays frame = frame_rays(view, solid.bounds());
  MemorySink sink(frame, hits);
  trace_tiles(solid, frame, subject_of(solid, view, options), options, sink, stats);
}

void draw(const Subdivision& subdivision, const View& view, const FrameSettings& settings,
          const TraceOptions& options, Image& image, TraceStats& stats) {
  draw(subdivision.solid(), view, settings, options, image, stats);
}

void trace(const Subdivision& subdivision, const View& view, const TraceOptions& options,
           Hits& hits, TraceStats& stats) {
  trace(subdivision.solid(), view, options, hits, stats);
}

}  // namespace csgcore
