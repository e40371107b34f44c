#include <algorithm>
#include <map>
#include <type_traits>

#include "base/elapsed.hpp"
#include "csgcore/changed_areas.hpp"
#include "frontend/render.hpp"
#include "glrender/renderer.hpp"
#include "render/scene_subdivision.hpp"
#include "render/solid_renderer.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using csgcore::Solid;
using csgcore::Subdivision;

/// Calls `function`, turning what OpenGL throws into what render() expects.
template <typename Function>
auto translate_errors(Function function) {
  try {
    return function();
  } catch (const glrender::ShaderMissing&) {
    throw ShaderMissing();
  } catch (const glrender::GlError& error) {
    throw GlFailure(error.what());
  }
}

class GlRenderer final : public SolidRenderer {
 public:
  explicit GlRenderer(const GlDemands& demands) {
    if (!demands.takes_software && is_software(context_.renderer_name())) {
      throw GlFailure("OpenGL runs in software here: " + context_.renderer_name());
    }
    context_.set_most_texels(std::min(context_.most_texels(), demands.most_texels));
  }

  Image draw_model(const Solid& solid, const csgcore::FrameSettings& frame,
                   const PictureRequest& request) override {
    return translate_errors([&] {
      request.stats.renderer = "gl: " + context_.renderer_name();
      return with_technique(request, [&](glrender::Technique technique) {
        return draw_model(solid, frame_settings(frame, request.settings, technique), request);
      });
    });
  }

  void draw_layers(const LayerSurfaces& layers, const PictureRequest& request,
                   Compositor& compositor) override {
    request.stats.renderer = "gl: " + context_.renderer_name();
    Sides sides;
    for (uint32_t turn = 0; turn < layers.turns.size(); ++turn) {
      if (request.settings.stop.stop_requested()) return;
      const csgcore::Surface& surface = layers.surfaces[layers.turns[turn]];
      const csgcore::PixelArea area = csgcore::area_of(*surface.solid, request.view);
      if (area.empty()) continue;
      const bool is_behind = surface.boundary == csgcore::Boundary::kBehind;
      const bool is_drawn =
          !is_behind && sides.solid == surface.solid && turn > 0 && !layers.blended[turn].is_part;
      if (!is_drawn) translate_errors([&] { sides = draw_sides(surface, request); });
      compositor.blend(turn, is_behind ? sides.behind : sides.front, area);
    }
  }

  void forget() override {
    loaded_.clear();
    subdivisions_.forget();
  }

  void set_compiles(bool compiles) override { context_.set_compiles(compiles); }
  void leave_thread() override { context_.leave_thread(); }
  void take_thread() override {
    translate_errors([&] { context_.take_thread(); });
  }

 private:
  /// A solid as OpenGL holds it.
  struct Loaded {
    Loaded(glrender::HeadlessContext& context, const Solid& solid) : renderer(context, solid) {}
    glrender::Renderer renderer;
    bool has_cells = false;
  };

  /// Calls `draw` with the technique that the settings ask for, and with cells where tiles have
  /// lists that are too long for OpenGL. A picture counts as one of cells if any of it is.
  template <typename Draw>
  static std::invoke_result_t<Draw, glrender::Technique> with_technique(
      const PictureRequest& request, Draw draw) {
    std::string& technique = request.stats.technique;
    if (!uses_cells(request.settings)) {
      try {
        auto drawn = draw(glrender::Technique::kTiles);
        if (technique.empty()) technique = "tiles";
        return drawn;
      } catch (const glrender::ListsTooLong&) {
      }
    }
    technique = "cells";
    return draw(glrender::Technique::kCells);
  }

  /// The pictures of a surface's solid, with measured channels.
  struct Sides {
    const Solid* solid = nullptr;
    Image front;   // where each ray enters the solid
    Image behind;  // and where it leaves it again, if that is the surface
  };
  Sides draw_sides(const csgcore::Surface& surface, const PictureRequest& request) {
    return with_technique(request, [&](glrender::Technique technique) {
      glrender::Renderer& renderer = load(*surface.solid, request, technique);
      const glrender::FrameSettings frame =
          frame_settings(surface.frame, request.settings, technique);
      Sides drawn{surface.solid, {}, {}};
      drawn.front =
          count([&](auto& stats) { return renderer.draw(request.view, frame, stats); }, request);
      if (surface.boundary == csgcore::Boundary::kFirst) return drawn;
      drawn.behind = count(
          [&](auto& stats) { return renderer.draw_behind(request.view, frame, stats); }, request);
      return drawn;
    });
  }

  Image draw_model(const Solid& solid, glrender::FrameSettings frame,
                   const PictureRequest& request) {
    const bool has_cells = frame.technique == glrender::Technique::kCells;
    glrender::Renderer& renderer = load(solid, request, frame.technique);
    if (has_cells) count_cells(subdivisions_.of(solid, request).subdivision, request.stats);
    frame.samples = samples_of(request.settings);
    if (request.settings.show == Show::kCells) frame.subject = glrender::Subject::kCells;
    Image image =
        count([&](auto& stats) { return renderer.draw(request.view, frame, stats); }, request);
    if (has_cells && request.settings.all_stats) {
      measure(renderer, frame, request);
      loaded_.erase(&solid);  // measuring leaves nothing loaded
    }
    return image;
  }

  /// With its cells, as the view needs them, if they are what is drawn.
  glrender::Renderer& load(const Solid& solid, const PictureRequest& request,
                           glrender::Technique technique) {
    Loaded& loaded = loaded_.try_emplace(&solid, context_, solid).first->second;
    if (technique == glrender::Technique::kCells) {
      const auto [subdivision, changed] = subdivisions_.of(solid, request);
      if (changed || !loaded.has_cells) loaded.renderer.load(subdivision);
      loaded.has_cells = true;
    }
    return loaded.renderer;
  }

  static glrender::FrameSettings frame_settings(const csgcore::FrameSettings& frame,
                                                const RenderSettings& settings,
                                                glrender::Technique technique) {
    glrender::FrameSettings result;
    static_cast<csgcore::FrameSettings&>(result) = frame;
    result.edge = color_of(settings.scheme.axes);
    result.technique = technique;
    result.threads = settings.threads;
    return result;
  }

  template <typename Draw>
  static Image count(Draw draw, const PictureRequest& request) {
    glrender::FrameStats frame;
    Image image = draw(frame);
    RenderStats& stats = request.stats;
    stats.draw_calls += frame.draw_calls;
    stats.cells_drawn += frame.cells_drawn;
    stats.trace.tiles += frame.tiles_drawn;
    stats.traverse_ms += frame.list_ms + frame.traverse_ms;
    stats.render_ms += frame.draw_ms + frame.read_ms;
    stats.read_ms += frame.read_ms;
    return image;
  }

  /// Draws again, one sample a pixel: by now every shader is compiled.
  static void measure(glrender::Renderer& renderer, glrender::FrameSettings frame,
                      const PictureRequest& request) {
    const Clock::time_point start = Clock::now();
    frame.samples = 1;
    glrender::FrameStats drawn;
    renderer.draw(request.view, frame, drawn);
    RenderStats& stats = request.stats;
    stats.paper_tr_ms = drawn.traverse_ms + drawn.draw_ms;
    stats.paper_ts_ms = renderer.traversal_ms(request.view);
    renderer.draw_while_subdividing(subdivision_options(request.view, request.settings),
                                    request.view, frame, drawn);
    stats.paper_sr_ms = drawn.draw_ms;
    stats.measuring_ms = ms_since(start);
  }

  glrender::HeadlessContext context_;
  SceneSubdivisions subdivisions_;
  std::map<const Solid*, Loaded> loaded_;
};

}  // namespace

std::unique_ptr<SolidRenderer> make_gl_renderer(const GlDemands& demands) {
  return translate_errors([&] { return std::make_unique<GlRenderer>(demands); });
}

bool needs_gl_program(const RenderSettings&) { return false; }

}  // namespace frontend
