#include <optional>
#include <span>
#include <vector>

#include "base/elapsed.hpp"
#include "csgcore/phong_shadows.hpp"
#include "csgcore/studio.hpp"
#include "csgcore/surfaces.hpp"
#include "csgcore/tracer.hpp"
#include "render/scene_subdivision.hpp"
#include "render/solid_renderer.hpp"

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

csgcore::TraceOptions trace_options(const RenderSettings& settings, Boundary boundary) {
  csgcore::TraceOptions options;
  options.threads = settings.threads;
  options.boundary = boundary;
  options.stop = settings.stop;
  return options;
}

class CpuRenderer final : public SolidRenderer {
 public:
  Image draw_model(const Solid& solid, const FrameSettings& frame,
                   const PictureRequest& request) override {
    note_renderer(request);
    if (request.settings.show == Show::kCells) return draw_cells(solid, frame, request);
    Image image;
    with_traced(solid, request, [&](const auto& traced) {
      draw_area(traced, frame, request, std::nullopt, image);
    });
    return image;
  }

  Image draw_shadowed_model(const Solid& solid, const FrameSettings& frame,
                            const csgcore::Box& light_box, const PictureRequest& request) override {
    if (!draws_studio(request.settings) || uses_cells(request.settings)) {
      return SolidRenderer::draw_shadowed_model(solid, frame, light_box, request);
    }
    note_renderer(request);
    Image image;
    TraceStats stats;
    csgcore::draw_studio(solid, request.view, frame, request.settings.studio,
                         trace_options(request.settings, Boundary::kFirst), image, stats);
    add(stats, request.stats);
    return image;
  }

  bool draws_areas() const override { return true; }

  void draw_model_areas(const Solid& solid, const FrameSettings& frame,
                        const PictureRequest& request, std::span<const csgcore::PixelArea> areas,
                        Image& image) override {
    note_renderer(request);
    if (areas.empty()) return;
    with_traced(solid, request, [&](const auto& traced) {
      for (const csgcore::PixelArea& area : areas) draw_area(traced, frame, request, area, image);
    });
  }

  void draw_layers(const LayerSurfaces& layers, const PictureRequest& request,
                   Compositor& compositor) override {
    note_renderer(request);
    std::vector<csgcore::Surface> surfaces = layers.surfaces;
    if (uses_cells(request.settings)) {
      for (csgcore::Surface& surface : surfaces) {
        surface.subdivision = &subdivisions_.of(*surface.solid, request).subdivision;
      }
    }
    TraceStats frame_stats;
    csgcore::draw_surfaces(surfaces, layers.turns, request.view,
                           trace_options(request.settings, Boundary::kFirst), compositor,
                           frame_stats);
    add(frame_stats, request.stats);
  }

  void forget() override { subdivisions_.forget(); }

 private:
  static void note_renderer(const PictureRequest& request) {
    request.stats.renderer = "cpu";
    request.stats.technique = uses_cells(request.settings) ? "cells" : "tiles";
  }

  /// Calls `draw` with what the model's rays are traced through.
  template <typename Draw>
  void with_traced(const Solid& solid, const PictureRequest& request, Draw draw) {
    if (uses_cells(request.settings)) {
      draw(subdivide_model(solid, request));
    } else {
      draw(solid);
    }
  }

  /// No area: the whole picture.
  template <typename Traced>
  static void draw_area(const Traced& traced, const FrameSettings& frame,
                        const PictureRequest& request, std::optional<csgcore::PixelArea> area,
                        Image& image) {
    csgcore::TraceOptions options = trace_options(request.settings, Boundary::kFirst);
    options.samples = samples_of(request.settings);
    options.area = area;
    TraceStats frame_stats;
    csgcore::draw(traced, request.view, frame, options, image, frame_stats);
    add(frame_stats, request.stats);
  }

  const Subdivision& subdivide_model(const Solid& solid, const PictureRequest& request) {
    const Subdivision& subdivision = subdivisions_.of(solid, request).subdivision;
    count_cells(subdivision, request.stats);
    return subdivision;
  }

  Image draw_cells(const Solid& solid, const FrameSettings& frame, const PictureRequest& request) {
    const Subdivision& subdivision = subdivide_model(solid, request);
    const Clock::time_point start = Clock::now();
    Image image =
        cells_picture(subdivision, request.view, frame, color_of(request.settings.scheme.axes));
    request.stats.render_ms += ms_since(start);
    return image;
  }

  SceneSubdivisions subdivisions_;
};

}  // namespace

void draw_shadows(const Solid& solid, const csgcore::Box& light_box, const PictureRequest& request,
                  Image& image) {
  TraceStats stats;
  const csgcore::TraceOptions options = trace_options(request.settings, Boundary::kFirst);
  if (draws_studio(request.settings)) {
    csgcore::finish_studio(solid, request.view, request.settings.studio, options, image, stats);
  } else {
    csgcore::cast_phong_shadows(solid, request.view, light_box, request.settings.phong_shadows,
                                options, image, stats);
  }
  add(stats, request.stats);
}

Image SolidRenderer::draw_shadowed_model(const Solid& solid, const FrameSettings& frame,
                                         const csgcore::Box& light_box,
                                         const PictureRequest& request) {
  Image image = draw_model(solid, frame, request);
  draw_shadows(solid, light_box, request, image);
  return image;
}

std::unique_ptr<SolidRenderer> make_cpu_renderer() { return std::make_unique<CpuRenderer>(); }

}  // namespace frontend
