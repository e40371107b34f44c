#include "measurement.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "base/elapsed.hpp"
#include "frontend/scene_renderer.hpp"
#include "render/solid_renderer.hpp"

namespace bench {
namespace {

/// At most one in this many hits may lie so near to an edge that float shows the other side of it;
/// in a small picture kEdgePixels may (tests/glrender/cpu_agreement_test.cpp).
constexpr uint64_t kHitsPerEdgePixel = 2000;
constexpr uint64_t kEdgePixels = 4;
/// Unit normals further apart belong to different faces.
constexpr float kFaceDistance = 0.05f;

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

/// The median, minimum and quartiles of one or more times.
Json summarise(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto quantile = [&](double share) {  // between the two values that are nearest to the place
    const double place = share * static_cast<double>(values.size() - 1);
    const size_t below = static_cast<size_t>(place);
    const size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
  };
  return {{"median", quantile(0.5)},
          {"least", values.front()},
          {"quartiles", {quantile(0.25), quantile(0.75)}},
          {"count", values.size()}};
}

/// The times of the stages of first frames, with one entry a run.
struct Runs {
  std::vector<double> first, context, subdivide, shaders;
  RenderStats stats;  // of the last
};

class Measurement {
 public:
  Measurement(const ScenePointer& scene, std::span<const View> views, const Settings& settings,
              const Progress& progress)
      : scene_(scene), views_(views), settings_(settings), progress_(progress) {}

  Json run() {
    const uint64_t pixels = uint64_t{views_[0].width_px} * views_[0].height_px;
    if (!scene_->model.empty()) {
      exact_ = picture(settings_of(kMethods[0], Rule{}));
      hits_ = pixels - static_cast<uint64_t>(
                           std::count(exact_.id.begin(), exact_.id.end(), csgcore::kNoPrimitive));
      for (const Method& method : kMethods) {
        if (is_wanted(method.renderer)) measure_frames(method);
      }
      for (const Rule& rule : settings_.rules) measure_rule(rule);
    }
    return {{"primitives", scene_->primitives.size()},
            {"pixels", pixels},
            {"hits", hits_},
            {"frames", frames_},
            {"rules", rules_},
            {"left_out", left_out_},
            {"wrong", wrong_}};
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
      left_out_.push_back("OpenGL: " + failure.reason());
      return std::nullopt;
    }
  }

  /// Returns whether the method may be measured. Pictures with a threshold are not judged: dropping
  /// cells may change them.
  bool is_right(const Method& method, const Rule& rule, const Image& image, uint64_t wrong) {
    if (rule.threshold_px > 0) return true;
    const bool right = method.renderer == RendererKind::kCpu ? is_same(image, exact_)
                                                             : float_explains(wrong, hits_);
    if (!right) {
      wrong_.push_back(name_of(method) + ": " + std::to_string(wrong) + " of " +
                       std::to_string(exact_.id.size()) +
                       " pixels show another face than the CPU's picture by tiles");
    }
    return right;
  }

  void measure_frames(const Method& method) {
    const Rule& rule = settings_.rules[0];
    progress_(name_of(method) + ": first frames");
    const std::optional<Image> image = try_picture(method, rule);
    if (!image) return;
    const uint64_t wrong = wrong_pixels(*image, exact_);
    if (!is_right(method, rule, *image, wrong)) return;
    const RenderSettings settings = settings_of(method, rule);
    const bool by_gl = method.renderer == RendererKind::kGl;
    Runs runs = first_frames(settings);
    Json times = {{"renderer", runs.stats.renderer}, {"technique", runs.stats.technique}};
    if (by_gl) times["context"] = summarise(std::move(runs.context));
    times["first"] = summarise(std::move(runs.first));
    if (method.technique == Technique::kCells) {
      times["first_subdivide"] = summarise(std::move(runs.subdivide));
    }
    if (by_gl) times["first_shaders"] = summarise(std::move(runs.shaders));
    progress_(name_of(method) + ": steady frames");
    times["steady"] = steady_frames(settings);
    times["wrong_pixels"] = wrong;
    frames_.push_back(std::move(times));
  }

  Runs first_frames(const RenderSettings& settings) const {
    Runs runs;
    draw_first(settings, runs);  // what is slower only the first time does not count
    runs = {};
    const Clock::time_point start = Clock::now();
    while (!settings_.repetitions.enough(runs.first.size(), ms_since(start))) {
      draw_first(settings, runs);
    }
    return runs;
  }

  void draw_first(const RenderSettings& settings, Runs& runs) const {
    SceneRenderer renderer;
    RenderStats first, again;
    const Clock::time_point start = Clock::now();
    renderer.load(scene_);
    renderer.draw(views_[0], settings, first);
    runs.first.push_back(ms_since(start) - first.context_ms);
    runs.context.push_back(first.context_ms);
    runs.subdivide.push_back(first.subdivide_ms);
    runs.stats = first;
    if (settings.renderer != RendererKind::kGl) return;
    renderer.draw(views_[0], settings, again);
    runs.shaders.push_back(std::max(0.0, first.render_ms - again.render_ms));
  }

  Json steady_frames(const RenderSettings& settings) const {
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
    return summarise(std::move(frames));
  }

  void measure_rule(const Rule& rule) {
    progress_("the paper's times, K = " + std::to_string(rule.leaf_primitives));
    Json times = {{"leaf_primitives", rule.leaf_primitives}, {"threshold_px", rule.threshold_px}};
    const Json cpu = measure_by_cpu(rule, times);
    if (is_wanted(RendererKind::kGl)) measure_by_gl(rule, times);
    if (is_wanted(RendererKind::kCpu)) times["cpu"] = cpu;
    rules_.push_back(std::move(times));
  }

  /// S is measured on the CPU, whichever renderer draws. Returns the CPU's own times.
  Json measure_by_cpu(const Rule& rule, Json& times) {
    const Method method{RendererKind::kCpu, Technique::kCells};
    const RenderSettings settings = settings_of(method, rule);
    const uint64_t wrong = wrong_pixels(picture(settings), exact_);
    RenderStats cells;
    std::vector<double> subdivide, render;
    const Clock::time_point start = Clock::now();
    while (!settings_.repetitions.enough(subdivide.size(), ms_since(start))) {
      SceneRenderer renderer;
      renderer.load(scene_);
      renderer.draw(views_[0], settings, cells);
      subdivide.push_back(cells.subdivide_ms);
      if (!is_wanted(RendererKind::kCpu)) continue;
      RenderStats again;
      renderer.draw(views_[0], settings, again);
      render.push_back(again.render_ms);
    }
    times["leaves"] = cells.leaves;
    times["leaves_dropped"] = cells.leaves_dropped;
    times["leaves_given_up"] = cells.leaves_given_up;
    times["S"] = summarise(std::move(subdivide));
    if (render.empty()) return {};
    return {{"T_R", summarise(std::move(render))}, {"wrong_pixels", wrong}};
  }

  void measure_by_gl(const Rule& rule, Json& times) {
    const Method method{RendererKind::kGl, Technique::kCells};
    const std::optional<Image> image = try_picture(method, rule);
    if (!image) return;
    const uint64_t wrong = wrong_pixels(*image, exact_);
    if (!is_right(method, rule, *image, wrong)) return;
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
    times["gl"] = {{"T_S", summarise(std::move(pass))}, {"T_R", summarise(std::move(render))},
                   {"S_R", summarise(std::move(both))}, {"draw_calls", stats.draw_calls},
                   {"cells_drawn", stats.cells_drawn},  {"wrong_pixels", wrong}};
  }

  const ScenePointer& scene_;
  const std::span<const View> views_;
  const Settings& settings_;
  const Progress& progress_;
  Image exact_;  // by the CPU's tiles
  uint64_t hits_ = 0;
  bool has_gl_ = true;
  Json frames_ = Json::array(), rules_ = Json::array();
  Json left_out_ = Json::array(), wrong_ = Json::array();
};

}  // namespace

uint64_t wrong_pixels(const csgcore::Image& image, const csgcore::Image& exact) {
  uint64_t wrong = 0;
  for (size_t i = 0; i < exact.id.size(); ++i) {
    wrong += image.id[i] != exact.id[i] ||
             glm::distance(image.normal[i], exact.normal[i]) > kFaceDistance;
  }
  return wrong;
}

bool is_same(const csgcore::Image& a, const csgcore::Image& b) {
  return a.rgb == b.rgb && a.id == b.id && a.z == b.z && a.normal == b.normal &&
         a.position == b.position;
}

bool float_explains(uint64_t wrong_pixels, uint64_t hits) {
  return wrong_pixels <= std::max(kEdgePixels, hits / kHitsPerEdgePixel);
}

Json measure(const ScenePointer& scene, std::span<const View> views, const Settings& settings,
             const Progress& progress) {
  return Measurement(scene, views, settings, progress).run();
}

}  // namespace bench
