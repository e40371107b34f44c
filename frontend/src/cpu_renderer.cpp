// The drawing by the CPU tracer, csgcore/tracer.hpp.
#include "cells_picture.hpp"
#include "csgcore/tracer.hpp"
#include "elapsed.hpp"
#include "scene_subdivision.hpp"
#include "solid_renderer.hpp"

namespace frontend {
namespace {

using csgcore::Boundary;
using csgcore::FrameSettings;
using csgcore::Image;
using csgcore::Solid;
using csgcore::Subdivision;
using csgcore::TraceStats;

/// Times and counts of a picture that is drawn with others. Primitives are counted once, by the
/// model.
void add(const TraceStats& frame, RenderStats& stats) {
  stats.trace.tiles += frame.tiles;
  stats.trace.rays += frame.rays;
  stats.trace.intersections += frame.intersections;
  stats.trace.resolved_rays += frame.resolved_rays;
  stats.trace.edge_pixels += frame.edge_pixels;
  stats.trace.cull_ms += frame.cull_ms;
  stats.trace.trace_ms += frame.trace_ms;
  stats.render_ms += frame.cull_ms + frame.trace_ms;
}

class CpuRenderer final : public SolidRenderer {
 public:
  CpuRenderer(const csgcore::View& view, const RenderSettings& settings, RenderStats& stats)
      : view_(view), settings_(settings), stats_(stats) {
    stats_.renderer = "cpu";
    stats_.technique = uses_cells() ? "cells" : "tiles";
  }

  Image draw_model(const Solid& solid, const FrameSettings& frame) override {
    if (settings_.show == Show::kCells) return draw_cells(solid, frame);
    csgcore::TraceOptions options = trace_options(Boundary::kFirst);
    options.samples = samples_of(settings_);
    options.count_skipped = settings_.all_stats;
    TraceStats frame_stats;
    Image image;
    if (uses_cells()) {
      const Subdivision subdivision = subdivide_model(solid, view_, settings_, stats_);
      csgcore::draw(subdivision, view_, frame, options, image, frame_stats);
    } else {
      csgcore::draw(solid, view_, frame, options, image, frame_stats);
    }
    add(frame_stats, stats_);
    stats_.trace.primitives = frame_stats.primitives;
    stats_.trace.intersected = frame_stats.intersected;
    stats_.trace.skipped = frame_stats.skipped;
    return image;
  }

  Sides draw_sides(const Solid& solid, const FrameSettings& frame) override {
    if (!uses_cells()) return trace_sides(solid, frame);
    return trace_sides(Subdivision(solid, subdivision_options(view_, settings_)), frame);
  }

 private:
  bool uses_cells() const {
    return settings_.technique == Technique::kCells || settings_.show == Show::kCells;
  }

  csgcore::TraceOptions trace_options(Boundary boundary) const {
    csgcore::TraceOptions options;
    options.threads = settings_.threads;
    options.boundary = boundary;
    return options;
  }

  Image draw_cells(const Solid& solid, const FrameSettings& frame) {
    const Subdivision subdivision = subdivide_model(solid, view_, settings_, stats_);
    const Clock::time_point start = Clock::now();
    Image image = cells_picture(subdivision, view_, frame, color_of(settings_.scheme.axes));
    stats_.render_ms += ms_since(start);
    return image;
  }

  template <typename Traced>
  Sides trace_sides(const Traced& traced, const FrameSettings& frame) {
    Sides sides;
    TraceStats frame_stats;
    csgcore::draw(traced, view_, frame, trace_options(Boundary::kFirst), sides.front, frame_stats);
    add(frame_stats, stats_);
    frame_stats = {};
    csgcore::draw(traced, view_, frame, trace_options(Boundary::kBehind), sides.behind,
                  frame_stats);
    add(frame_stats, stats_);
    return sides;
  }

  const csgcore::View& view_;
  const RenderSettings& settings_;
  RenderStats& stats_;
};

}  // namespace

std::unique_ptr<SolidRenderer> make_cpu_renderer(const csgcore::View& view,
                                                 const RenderSettings& settings,
                                                 RenderStats& stats) {
  return std::make_unique<CpuRenderer>(view, settings, stats);
}

}  // namespace frontend
