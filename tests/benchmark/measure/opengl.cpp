// {"left_out": [reason, …],
//  "renderer": "gl: " and GL_RENDERER, "software": whether that runs on the CPU,
//  "frames": [{"design", "primitives", "width_px", "height_px", "leaf_primitives", "threshold_px",
//              "technique": "cells", or "tiles", which no rule concerns: with the first alone,
//              "leaves", "cells_drawn", "draw_calls",
//              "subdivide_ms", "upload_ms", "upload_bytes",      once, of the first frame
//              "frame": summary of a frame from the view to its picture in memory,
//              "traverse", "draw", "read": summaries of its parts,
//              "hits", "wrong_pixels": against the CPU's picture at 640 × 480}, …]}
// Without OpenGL "frames" is empty. Summaries are in ms. traverse: the cells in their order,
// or the tiles and their lists, brought to the GPU; draw: until OpenGL has finished; read: back
// into memory. The rest of a frame is what the CPU adds to it.
#include <algorithm>
#include <optional>

#include "base/elapsed.hpp"
#include "bench/measurement.hpp"
#include "bench/picture_check.hpp"
#include "frontend/error.hpp"
#include "frontend/render.hpp"
#include "frontend/scene_renderer.hpp"
#include "render/renderer_choice.hpp"
#include "subject.hpp"

namespace measure {
namespace {

using csgcore::Image;
using csgcore::View;
using frontend::RendererKind;
using frontend::RenderSettings;
using frontend::RenderStats;
using frontend::SceneRenderer;
using frontend::Technique;
using nlohmann::json;

struct Size {
  uint32_t width_px, height_px;
};
constexpr Size kSizes[] = {{640, 480}, {1920, 1080}, {3840, 2160}};
constexpr const char* kDesigns[] = {"r9", "cs1000", "cc1000", "t1022", "cs10000"};
constexpr bench::Rule kRules[] = {bench::Rule{}, bench::kPaperRule};
constexpr Technique kTechniques[] = {Technique::kTiles, Technique::kCells};

/// On the CPU, a frame of 4K takes seconds.
constexpr uint64_t kManyPixels = 3'000'000;

RenderSettings settings_of(RendererKind renderer, Technique technique, const bench::Rule& rule) {
  RenderSettings settings;
  settings.renderer = renderer;
  settings.technique = technique;
  settings.leaf_primitives = rule.leaf_primitives;
  settings.threshold_px = rule.threshold_px;
  return settings;
}

class OpenGlMeasurer {
 public:
  explicit OpenGlMeasurer(const Settings& settings) : settings_(settings) {}

  json run() {
    try {
      measure_all();
    } catch (const frontend::Error& error) {
      // OpenGL is left out if it fails at the first picture. If it can draw one, it can draw all.
      if (!frames_.empty()) throw;
      left_out_.add("OpenGL", error.what());
    }
    return {{"left_out", left_out_.reasons},
            {"renderer", renderer_},
            {"software", is_software_},
            {"frames", frames_}};
  }

 private:
  void measure_all() {
    for (const char* design : kDesigns) {
      if (settings_.quick && design != std::string("r9")) continue;
      const Subject subject = read_subject(design, settings_);
      say("opengl: " + subject.name);
      for (const bench::Rule& rule : kRules) {
        for (const Technique technique : kTechniques) {
          // Tiles have no cells that a rule could divide.
          if (technique == Technique::kTiles && rule.threshold_px > 0) continue;
          const json answer = check(subject, technique, rule);
          for (const Size& size : kSizes) {
            const bool is_large = size.width_px > kSizes[0].width_px;
            if (settings_.quick && is_large) continue;
            // It would take seconds a frame, and teach nothing that the small one does not.
            if (is_software_ && is_large && rule.threshold_px > 0) continue;
            json frame = measure_size(subject, technique, rule, size);
            frame.update(answer);
            frames_.push_back(std::move(frame));
          }
        }
      }
    }
  }

  /// Compares the picture with the CPU's, which was compared with the reference. Throws
  /// WrongAnswer.
  json check(const Subject& subject, Technique technique, const bench::Rule& rule) {
    const View view = default_view(subject, camera_options());
    require_exact(subject, view);
    const auto picture = [&](RendererKind renderer, Technique by, const bench::Rule& by_rule) {
      RenderSettings settings = settings_of(renderer, by, by_rule);
      settings.measured_channels = true;
      RenderStats stats;
      Image image = frontend::render(*subject.scene, view, settings, stats);
      if (renderer == RendererKind::kGl) renderer_ = stats.renderer;
      return image;
    };
    const Image exact = picture(RendererKind::kCpu, Technique::kTiles, {});
    const uint64_t wrong = bench::wrong_pixels(picture(RendererKind::kGl, technique, rule), exact);
    is_software_ = frontend::is_software(renderer_);
    const auto hits =
        exact.id.size() -
        static_cast<size_t>(std::count(exact.id.begin(), exact.id.end(), csgcore::kNoPrimitive));
    if (rule.threshold_px == 0 && !bench::float_explains(wrong, hits)) {
      throw WrongAnswer(subject.name + ": OpenGL has " + std::to_string(wrong) + " wrong pixels");
    }
    return {{"hits", hits}, {"wrong_pixels", wrong}};
  }

  Repetitions repetitions_of(const Size& size) const {
    const Repetitions& usual = settings_.repetitions;
    if (!is_software_) return usual;
    if (uint64_t{size.width_px} * size.height_px > kManyPixels) return {1, 1, 0};
    return {std::min<size_t>(usual.least, 3), usual.most, usual.long_enough_ms / 5};
  }

  json measure_size(const Subject& subject, Technique technique, const bench::Rule& rule,
                    const Size& size) const {
    const View view = default_view(subject, camera_options(size.width_px, size.height_px));
    const RenderSettings settings = settings_of(RendererKind::kGl, technique, rule);
    SceneRenderer renderer;
    renderer.load(subject.scene);
    RenderStats first;
    const double first_ms = timed([&] { renderer.draw(view, settings, first); })();
    std::vector<double> frame, traverse, draw, read;
    const Repetitions repetitions = repetitions_of(size);
    double total_ms = 0;
    while (!repetitions.enough(frame.size(), total_ms)) {
      RenderStats stats;
      frame.push_back(timed([&] { renderer.draw(view, settings, stats); })());
      traverse.push_back(stats.traverse_ms);
      draw.push_back(stats.render_ms - stats.read_ms);
      read.push_back(stats.read_ms);
      total_ms += frame.back();
    }
    return {{"design", subject.name},
            {"primitives", first.primitives},
            {"width_px", size.width_px},
            {"height_px", size.height_px},
            {"leaf_primitives", rule.leaf_primitives},
            {"threshold_px", rule.threshold_px},
            {"technique", first.technique},
            {"leaves", first.leaves},
            {"cells_drawn", first.cells_drawn},
            {"draw_calls", first.draw_calls},
            {"subdivide_ms", first.subdivide_ms},
            {"upload_ms", first_ms - first.context_ms - first.subdivide_ms - first.traverse_ms -
                              first.render_ms},
            {"upload_bytes", first.edit.bytes_uploaded},
            {"frame", summarise(std::move(frame))},
            {"traverse", summarise(std::move(traverse))},
            {"draw", summarise(std::move(draw))},
            {"read", summarise(std::move(read))}};
  }

  const Settings& settings_;
  LeftOut left_out_;
  std::string renderer_;
  bool is_software_ = false;
  json frames_ = json::array();
};

}  // namespace

json measure_opengl(const Settings& settings) { return OpenGlMeasurer(settings).run(); }

}  // namespace measure
