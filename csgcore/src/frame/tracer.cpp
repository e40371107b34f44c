#include "csgcore/tracer.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <thread>
#include <unordered_map>

#include "base/worker_threads.hpp"
#include "frame/cell_tracer.hpp"
#include "frame/edge_samples.hpp"
#include "frame/sparse_hits.hpp"
#include "rays/packet_blocks.hpp"

namespace csgcore {
namespace {

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

TraceParameters parameters_of(const Solid& solid, const TraceOptions& options) {
  TraceParameters parameters;
  parameters.thickness_tolerance =
      options.thickness_tolerance.value_or(thickness_tolerance(solid.bounds()));
  parameters.boundary = options.boundary;
  parameters.stop = options.stop;
  return parameters;
}

/// Traces each pixel through its centre.
class PixelVisitor final : public TileVisitor {
 public:
  PixelVisitor(const FrameRays& frame, HitSink& sink) : frame_(frame), sink_(sink) {}

  void visit_empty(const Tile& tile) override { sink_.clear(tile); }

  void visit(const Tile& tile, TileRays& rays) override {
    for_each_block(tile,
                   [&](const PacketBlock& block) { trace_block(frame_, block, rays, sink_); });
  }

 private:
  const FrameRays& frame_;
  HitSink& sink_;
};

/// Passes hits on to two others. The second one needs no misses.
class TwoSinks final : public HitSink {
 public:
  TwoSinks(HitSink& all, HitSink& of_hits) : all_(all), of_hits_(of_hits) {}
  void clear(const Tile& tile) override { all_.clear(tile); }
  void store(const PacketBlock& block, const RayPacket& rays, const TraceList& list,
             const PacketHits& hits) override {
    all_.store(block, rays, list, hits);
    of_hits_.store(block, rays, list, hits);
  }

 private:
  HitSink& all_;
  HitSink& of_hits_;
};

/// Draws one frame of a solid.
class Frame {
 public:
  Frame(const Solid& solid, const View& view, const TraceOptions& options, TraceStats& stats)
      : solid_(solid),
        options_(options),
        stats_(stats),
        area_(options.area.value_or(PixelArea{0, 0, view.width_px, view.height_px})),
        rays_(frame_rays(view, solid.bounds())),
        parameters_(parameters_of(solid, options)) {
    stats = {};
    assert(area_.x + area_.width <= view.width_px && area_.y + area_.height <= view.height_px);
  }

  const FrameRays& rays() const { return rays_; }

  /// Traces by a kd-tree, or by tiles if `subdivision` is null.
  void trace(const Subdivision* subdivision, HitSink& sink) { trace(subdivision, area_, sink); }

  void draw(const FrameSettings& settings, Image& image, SparseHits& hits) {
    ImageSink of_image(rays_, settings, solid_.bounds(), image);
    SparseSink of_hits(rays_, hits);
    TwoSinks sink(of_image, of_hits);
    trace(nullptr, sink);
  }

  void draw(const Subdivision* subdivision, const FrameSettings& settings, Image& image) {
    ImageSink sink(rays_, settings, solid_.bounds(), image);
    if (options_.samples <= 1 || area_.empty()) {
      trace(subdivision, area_, sink);
      return;
    }
    // The area's pixels may make edges of the pixels beside them. Whether these are edges depends
    // on their neighbours further out, by the colours of pixels' centres, which `image` no longer
    // holds.
    const PixelArea sampled = grown(area_, 1, rays_.view);
    const PixelArea looked_at = grown(area_, 2, rays_.view);
    const KeptColors kept(image, looked_at == sampled ? PixelArea{} : looked_at);
    trace(subdivision, looked_at, sink);
    if (!parameters_.stop.stop_requested()) sample_edges(sampled, sink, image);
    kept.restore_around(sampled, image);
  }

 private:
  void trace(const Subdivision* subdivision, const PixelArea& area, HitSink& sink) {
    if (area.empty()) return;
    with_threads(options_.threads, [&] {
      Stopwatch watch;
      if (subdivision) {
        CellTracer tracer(*subdivision, rays_, parameters_);
        tracer.trace(area, sink);
        add(tracer.counts());
        stats_.tiles = 0;
      } else {
        TileTracer tracer(solid_, rays_, parameters_, TileRules{});
        stats_.cull_ms = watch.lap_ms();
        PixelVisitor visitor(rays_, sink);
        tracer.visit(area, visitor);
        add(tracer.counts());
      }
      stats_.trace_ms += watch.lap_ms();
    });
  }

  void sample_edges(const PixelArea& area, const ImageSink& sink, Image& image) {
    with_threads(options_.threads, [&] {
      Stopwatch watch;
      const EdgeMap edges(image, area);
      stats_.edge_pixels = edges.count();
      TileTracer tracer(solid_, rays_, parameters_, TileRules{.centers_only = false});
      EdgeVisitor visitor(edges, options_.samples, rays_, sink, image);
      tracer.visit(area, visitor);
      add(tracer.counts());
      stats_.trace_ms += watch.lap_ms();
    });
  }

  void add(const TileTracer::Counts& counts) {
    stats_.tiles += counts.tiles;
    stats_.intersections += counts.intersections;
    stats_.resolved_rays += counts.resolved_rays;
    stats_.rays += counts.rays;
  }

  const Solid& solid_;
  const TraceOptions& options_;
  TraceStats& stats_;
  const PixelArea area_;
  const FrameRays rays_;
  const TraceParameters parameters_;
};

void draw_frame(const Solid& solid, const Subdivision* subdivision, const View& view,
                const FrameSettings& settings, const TraceOptions& options, Image& image,
                TraceStats& stats) {
  Frame frame(solid, view, options, stats);
  frame.draw(subdivision, settings, image);
}

void trace_frame(const Solid& solid, const Subdivision* subdivision, const View& view,
                 const TraceOptions& options, Hits& hits, TraceStats& stats) {
  Frame frame(solid, view, options, stats);
  MemorySink sink(frame.rays(), hits);
  frame.trace(subdivision, sink);
}

}  // namespace

Hits hits_of(const Image& image, const Scene& scene) {
  std::unordered_map<uint32_t, uint32_t> primitive_of;
  for (uint32_t i = 0; i < scene.primitives.size(); ++i) primitive_of[scene.primitives[i].id] = i;
  primitive_of[kNoPrimitive] = Hits::kMiss;
  Hits hits{image.width_px, image.height_px, {}, {}, {}, {}};
  hits.s.assign(image.z.begin(), image.z.end());
  for (const glm::vec3& p : image.position) hits.position.emplace_back(p);
  for (const glm::vec3& n : image.normal) hits.normal.emplace_back(n);
  for (const uint32_t id : image.id) hits.primitive.push_back(primitive_of.at(id));
  return hits;
}

void draw(const Solid& solid, const View& view, const FrameSettings& settings,
          const TraceOptions& options, Image& image, TraceStats& stats) {
  draw_frame(solid, nullptr, view, settings, options, image, stats);
}

void trace(const Solid& solid, const View& view, const TraceOptions& options, Hits& hits,
           TraceStats& stats) {
  trace_frame(solid, nullptr, view, options, hits, stats);
}

void trace(const Solid& solid, const View& view, const TraceOptions& options, SparseHits& hits,
           TraceStats& stats) {
  Frame frame(solid, view, options, stats);
  SparseSink sink(frame.rays(), hits);
  frame.trace(nullptr, sink);
}

void draw(const Solid& solid, const View& view, const FrameSettings& settings,
          const TraceOptions& options, Image& image, SparseHits& hits, TraceStats& stats) {
  Frame(solid, view, options, stats).draw(settings, image, hits);
}

void draw(const Subdivision& subdivision, const View& view, const FrameSettings& settings,
          const TraceOptions& options, Image& image, TraceStats& stats) {
  draw_frame(subdivision.solid(), &subdivision, view, settings, options, image, stats);
}

void trace(const Subdivision& subdivision, const View& view, const TraceOptions& options,
           Hits& hits, TraceStats& stats) {
  trace_frame(subdivision.solid(), &subdivision, view, options, hits, stats);
}

}  // namespace csgcore
