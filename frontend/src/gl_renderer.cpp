// The drawing by OpenGL.
#include <utility>

#include "elapsed.hpp"
#include "glrender/renderer.hpp"
#include "renderer_choice.hpp"
#include "scene_subdivision.hpp"
#include "solid_renderer.hpp"

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
  } catch (const glrender::GlError& error) {
    throw GlFailure(error.what());
  }
}

class GlRenderer final : public SolidRenderer {
 public:
  GlRenderer(const csgcore::View& view, const RenderSettings& settings, RenderStats& stats)
      : view_(view), settings_(settings), stats_(stats) {
    const std::string& name = context_.renderer_name();
    if (settings.renderer == RendererKind::kAuto && is_software(name)) {
      throw GlFailure("OpenGL runs in software here: " + name);
    }
    stats_.renderer = "gl: " + name;
    stats_.technique = "cells";
  }

  Image draw_model(const Solid& solid, const csgcore::FrameSettings& frame) override {
    return translate_errors([&] {
      const Subdivision subdivision = subdivide_model(solid, view_, settings_, stats_);
      glrender::Renderer renderer(context_, solid);
      renderer.load(subdivision);
      glrender::FrameSettings gl_frame = frame_settings(frame);
      gl_frame.samples = samples_of(settings_);
      if (settings_.show == Show::kCells) gl_frame.subject = glrender::Subject::kCells;
      Image image = count([&](auto& stats) { return renderer.draw(view_, gl_frame, stats); });
      if (settings_.all_stats) measure(renderer, gl_frame);
      return image;
    });
  }

  Sides draw_sides(const Solid& solid, const csgcore::FrameSettings& frame) override {
    return translate_errors([&] {
      const Subdivision subdivision(solid, subdivision_options(view_, settings_));
      glrender::Renderer renderer(context_, solid);
      renderer.load(subdivision);
      const glrender::FrameSettings gl_frame = frame_settings(frame);
      Sides sides;
      sides.front = count([&](auto& stats) { return renderer.draw(view_, gl_frame, stats); });
      sides.behind =
          count([&](auto& stats) { return renderer.draw_behind(view_, gl_frame, stats); });
      return sides;
    });
  }

 private:
  glrender::FrameSettings frame_settings(const csgcore::FrameSettings& frame) const {
    glrender::FrameSettings result;
    static_cast<csgcore::FrameSettings&>(result) = frame;
    result.edge = color_of(settings_.scheme.axes);
    return result;
  }

  template <typename Draw>
  Image count(Draw draw) {
    glrender::FrameStats frame;
    Image image = draw(frame);
    stats_.draw_calls += frame.draw_calls;
    stats_.cells_drawn += frame.cells_drawn;
    stats_.traverse_ms += frame.traverse_ms;
    stats_.render_ms += frame.draw_ms + frame.read_ms;
    return image;
  }

  /// Draws again, one sample a pixel: by now every shader is compiled.
  void measure(glrender::Renderer& renderer, glrender::FrameSettings frame) {
    const Clock::time_point start = Clock::now();
    frame.samples = 1;
    glrender::FrameStats stats;
    renderer.draw(view_, frame, stats);
    stats_.paper_tr_ms = stats.traverse_ms + stats.draw_ms;
    stats_.paper_ts_ms = renderer.traversal_ms(view_);
    renderer.draw_while_subdividing(subdivision_options(view_, settings_), view_, frame, stats);
    stats_.paper_sr_ms = stats.draw_ms;
    stats_.measuring_ms = ms_since(start);
  }

  const csgcore::View& view_;
  const RenderSettings& settings_;
  RenderStats& stats_;
  glrender::HeadlessContext context_;
};

}  // namespace

std::unique_ptr<SolidRenderer> make_gl_renderer(const csgcore::View& view,
                                                const RenderSettings& settings,
                                                RenderStats& stats) {
  const Clock::time_point start = Clock::now();
  auto renderer =
      translate_errors([&] { return std::make_unique<GlRenderer>(view, settings, stats); });
  stats.context_ms = ms_since(start);
  return renderer;
}

}  // namespace frontend
