#include "measurement.hpp"

#include <algorithm>

#include "base/elapsed.hpp"
#include "frontend/scene_renderer.hpp"
#include "picture_check.hpp"
#include "render/gl_renderer.hpp"

namespace bench {
namespace {

using csgcore::Image;
using csgcore::View;
using frontend::Clock;
using frontend::ms_since;
using frontend::RendererKind;
using frontend::RenderSettings;
using frontend::RenderStats;
using frontend::SceneRenderer;
using frontend::Technique;

struct Method {
  RendererKind renderer;
  Technique technique;
};
constexpr Method kMethods[] = {{RendererKind::kCpu, Technique::kTiles},
                               {RendererKind::kCpu, Technique::kCells},
                               {RendererKind::kGl, Technique::kTiles},
                               {RendererKind::kGl, Technique::kCells}};

std::string name_of(const Method& method) {
  return std::string(method.renderer == RendererKind::kGl ? "gl" : "cpu") +
         (method.technique == Technique::kCells ? ", cells" : ", tiles");
}

/// The times of the stages, with one entry a run.
struct Runs {
  std::vector<double> first, context, subdivide, shaders;
};

class Measurement {
 public:
  Measurement(const ScenePointer& scene, std::span<const View> views, const Settings& settings,
              const Progress& progress)
      : scene_(scene), views_(views), settings_(settings), progress_(progress) {}

  Result run() {
    result_.primitives = scene_->primitives.size();
    result_.pixels = uint64_t{views_[0].width_px} * views_[0].height_px;
    if (scene_->model.empty()) return std::move(result_);
    exact_ = picture(settings_of(kMethods[0], Rule{}));
    result_.hits = result_.pixels - static_cast<uint64_t>(std::count(
                                        exact_.id.begin(), exact_.id.end(), csgcore::kNoPrimitive));
    for (const Method& method : kMethods) {
      if (settings_.frames && is_wanted(method.renderer)) measure_frames(method);
    }
    for (const Rule& rule : settings_.rules) measure_rule(rule);
    return std::move(result_);
  }

 private:
  bool is_wanted(RendererKind renderer) const {
    if (renderer == RendererKind::kGl && !has_gl_) return false;
    return settings_.renderer == RendererKind::kAuto || settings_.renderer == renderer;
  }

  RenderSettings settings_of(const Method& method, const Rule& rule) const {
    RenderSettings settings;
    settings.renderer = method.renderer;
    settings.technique = method.technique;
    settings.leaf_primitives = rule.leaf_primitives;
    settings.threshold_px = rule.threshold_px;
    settings.threads = settings_.threads;
    return settings;
  }

  /// Draws the first view, with measured channels.
  Image picture(RenderSettings settings) const {
    settings.measured_channels = true;
    SceneRenderer renderer;
    renderer.load(scene_);
    RenderStats stats;
    return renderer.draw(views_[0], settings, stats);
  }

  /// Returns the method's picture, if it can draw one.
  std::optional<Image> try_picture(const Method& method, const Rule& rule) {
    try {
      return picture(settings_of(method, rule));
    } catch (const frontend::GlFailure& failure) {
      if (settings_.renderer == RendererKind::kGl) throw;
      has_gl_ = false;
      result_.left_out.push_back("OpenGL: " + failure.reason());
      return std::nullopt;
    }
  }

  /// Returns whether the method may be measured. Pictures with a threshold are not judged: dropping
  /// cells may change them.
  bool is_right(const Method& method, const Rule& rule, const Image& image, uint64_t wrong) {
    if (rule.threshold_px > 0) return true;
    const bool right = method.renderer == RendererKind::kCpu ? is_same(image, exact_)
                                                             : float_explains(wrong, result_.hits);
    if (!right) {
      result_.wrong.push_back(name_of(method) + ": " + std::to_string(wrong) + " of " +
                              std::to_string(result_.pixels) +
                              " pixels show another face than the CPU's picture by tiles");
    }
    return right;
  }

  void measure_frames(const Method& method) {
    const Rule& rule = settings_.rules[0];
    progress_(name_of(method) + ": first frames");
    const std::optional<Image> image = try_picture(method, rule);
    if (!image) return;
    FrameTimes times;
    times.wrong_pixels = wrong_pixels(*image, exact_);
    if (!is_right(method, rule, *image, times.wrong_pixels)) return;
    const RenderSettings settings = settings_of(method, rule);
    measure_first(settings, times);
    progress_(name_of(method) + ": steady frames");
    measure_steady(settings, times);
    result_.frames.push_back(std::move(times));
  }

  void measure_first(const RenderSettings& settings, FrameTimes& times) const {
    Runs runs;
    draw_first(settings, times, runs);  // what is slower only the first time does not count
    runs = {};
    const Clock::time_point start = Clock::now();
    while (!settings_.repetitions.enough(runs.first.size(), ms_since(start))) {
      draw_first(settings, times, runs);
    }
    times.first = summarise(std::move(runs.first));
    if (settings.technique == Technique::kCells) {
      times.subdivide = summarise(std::move(runs.subdivide));
    }
    if (settings.renderer == RendererKind::kGl) {
      times.context = summarise(std::move(runs.context));
      times.shaders = summarise(std::move(runs.shaders));
    }
  }

  void draw_first(const RenderSettings& settings, FrameTimes& times, Runs& runs) const {
    SceneRenderer renderer;
    RenderStats first, again;
    const Clock::time_point start = Clock::now();
    renderer.load(scene_);
    renderer.draw(views_[0], settings, first);
    runs.first.push_back(ms_since(start) - first.context_ms);
    runs.context.push_back(first.context_ms);
    runs.subdivide.push_back(first.subdivide_ms);
    times.renderer = first.renderer;
    times.technique = first.technique;
    if (settings.renderer != RendererKind::kGl) return;
    renderer.draw(views_[0], settings, again);
    runs.shaders.push_back(std::max(0.0, first.render_ms - again.render_ms));
  }

  void measure_steady(const RenderSettings& settings, FrameTimes& times) const {
    SceneRenderer renderer;
    renderer.load(scene_);
    RenderStats stats;
    renderer.draw(views_[0], settings, stats);
    std::vector<double> frames;
    const Clock::time_point start = Clock::now();
    while (!settings_.repetitions.enough(frames.size(), ms_since(start))) {
      const View& view = views_[(frames.size() + 1) % views_.size()];
      const Clock::time_point frame_start = Clock::now();
      renderer.draw(view, settings, stats);
      frames.push_back(ms_since(frame_start));
    }
    times.steady = summarise(std::move(frames));
  }

  void measure_rule(const Rule& rule) {
    RuleTimes times;
    times.rule = rule;
    progress_("the paper's times, K = " + std::to_string(rule.leaf_primitives));
    measure_by_cpu(rule, times);
    if (is_wanted(RendererKind::kGl)) measure_by_gl(rule, times);
    result_.rules.push_back(std::move(times));
  }

  /// S is measured on the CPU, whichever renderer draws.
  void measure_by_cpu(const Rule& rule, RuleTimes& times) {
    const Method method{RendererKind::kCpu, Technique::kCells};
    const RenderSettings settings = settings_of(method, rule);
    times.cpu_wrong_pixels = wrong_pixels(picture(settings), exact_);
    std::vector<double> subdivide, render;
    const Clock::time_point start = Clock::now();
    while (!settings_.repetitions.enough(subdivide.size(), ms_since(start))) {
      SceneRenderer renderer;
      renderer.load(scene_);
      renderer.draw(views_[0], settings, times.cells);
      subdivide.push_back(times.cells.subdivide_ms);
      if (!is_wanted(RendererKind::kCpu)) continue;
      RenderStats again;
      renderer.draw(views_[0], settings, again);
      render.push_back(again.render_ms);
    }
    times.subdivide = summarise(std::move(subdivide));
    if (!render.empty()) times.cpu_render = summarise(std::move(render));
  }

  void measure_by_gl(const Rule& rule, RuleTimes& times) {
    const Method method{RendererKind::kGl, Technique::kCells};
    const std::optional<Image> image = try_picture(method, rule);
    if (!image) return;
    GlTimes gl;
    gl.wrong_pixels = wrong_pixels(*image, exact_);
    if (!is_right(method, rule, *image, gl.wrong_pixels)) return;
    RenderSettings settings = settings_of(method, rule);
    settings.all_stats = true;
    SceneRenderer renderer;
    renderer.load(scene_);
    RenderStats stats;
    renderer.draw(views_[0], settings, stats);  // compiles the shaders
    std::vector<double> pass, render, both;
    const Clock::time_point start = Clock::now();
    while (!settings_.repetitions.enough(pass.size(), ms_since(start))) {
      renderer.draw(views_[0], settings, stats);
      pass.push_back(stats.paper_ts_ms);
      render.push_back(stats.paper_tr_ms);
      both.push_back(stats.paper_sr_ms);
    }
    gl.pass = summarise(std::move(pass));
    gl.render = summarise(std::move(render));
    gl.render_while_subdividing = summarise(std::move(both));
    gl.renderer = stats.renderer;
    gl.draw_calls = stats.draw_calls;
    gl.cells_drawn = stats.cells_drawn;
    times.gl = std::move(gl);
  }

  const ScenePointer& scene_;
  const std::span<const View> views_;
  const Settings& settings_;
  const Progress& progress_;
  Result result_;
  Image exact_;
  bool has_gl_ = true;
};

}  // namespace

Result measure(const ScenePointer& scene, std::span<const View> views, const Settings& settings,
               const Progress& progress) {
  return Measurement(scene, views, settings, progress).run();
}

}  // namespace bench
