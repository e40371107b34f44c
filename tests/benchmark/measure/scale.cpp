// Measures how times grow with primitives, parts that cannot be seen, pixels and threads. Scenes
// are in memory, without files, and the CPU draws, in double.
//
// {"width_px", "height_px", "threads",
//  "primitives": [{"family", "title", "rows": [{"primitives", "prepare_ms", "subdivide_ms",
//    "first_ms": a picture by tiles, "steady_ms": one by the finished cells, "cells", "leaves",
//    "subdivision_bytes", "peak_bytes": of all that together, null where the system does not
//    tell}]}],
//  "unseen": [{"scene", "alone_ms": 1,000 primitives that are seen, "grown_ms": and 99,000 that
//    are not, "ratio": of the medians, "least_ratio"}],
//  "pixels": [{"scene", "rows": [{"width_px", "height_px", "first_ms", "steady_ms"}]}],
//  "threads_rows": [{"scene", "width_px", "height_px", "rows": [{"threads", "subdivide_ms",
//    "first_ms", "steady_ms"}]}],
//  "left_out"}
#include <sys/sysinfo.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "../frame.hpp"
#include "../growth_scenes.hpp"
#include "../reference_check.hpp"
#include "csgcore/tracer.hpp"
#include "memory.hpp"
#include "scale_scenes.hpp"
#include "section.hpp"

namespace measure {
namespace {

using csgcore::Image;
using csgcore::Scene;
using csgcore::Solid;
using csgcore::Subdivision;
using csgcore::View;
using frame_benchmark::PictureSize;
using nlohmann::json;

/// For larger scenes only the two techniques are compared with each other, since the reference
/// tests every primitive for every ray.
constexpr uint32_t kMostForReference = 100'000;

/// A scene whose four stages together are expected to take longer is left out.
constexpr double kMostPass_ms = 20'000;

Repetitions repetitions_of(const Settings& settings, double pass_ms) {
  constexpr double kLongPass_ms = 4'000;
  if (settings.quick) return settings.repetitions;
  return pass_ms > kLongPass_ms ? Repetitions{1, 1, 0} : Repetitions{3, 20, 1'000};
}

/// Draws a scene from OpenSCAD's default camera, by both techniques.
class Drawn {
 public:
  Drawn(const Scene& scene, const PictureSize& size, unsigned threads)
      : scene_(scene), threads_(threads) {
    prepare();
    view_ = frame_benchmark::default_view(solid_->bounds(), size);
    subdivide();
    settings_.background = glm::vec3{0.0f};
    settings_.back = glm::vec3{0.5f};
  }

  // Each function returns the ms that it took; what it replaces is freed before the clock starts.
  double prepare() {
    subdivision_.reset();
    solid_.reset();
    return frame_benchmark::time_ms([&] {
      solid_ = std::make_unique<Solid>(csgcore::canonical_primitives(scene_), scene_.model);
    });
  }
  double subdivide() {
    csgcore::SubdivisionOptions options;
    options.threads = threads_;
    subdivision_.reset();
    return frame_benchmark::time_ms(
        [&] { subdivision_ = std::make_unique<Subdivision>(*solid_, options); });
  }
  double draw_by_tiles() { return draw(*solid_, by_tiles_); }
  double draw_by_cells() { return draw(*subdivision_, by_cells_); }

  const Subdivision& subdivision() const { return *subdivision_; }

  void require_right(const std::string& name) {
    draw_by_tiles();
    draw_by_cells();
    if (by_tiles_.rgb != by_cells_.rgb) {
      throw WrongAnswer(name + ": tiles and cells draw different pictures");
    }
    if (scene_.primitives.size() > kMostForReference) return;
    csgcore::Hits hits;
    csgcore::TraceStats stats;
    csgcore::trace(*solid_, view_, options(), hits, stats);
    if (!frame_benchmark::agrees_with_reference(scene_, view_, hits)) {
      throw WrongAnswer(name + ": not what the reference sees");
    }
  }

 private:
  csgcore::TraceOptions options() const {
    csgcore::TraceOptions options;
    options.threads = threads_;
    return options;
  }
  template <typename Model>
  double draw(const Model& model, Image& image) const {
    csgcore::TraceStats stats;
    return frame_benchmark::time_ms(
        [&] { csgcore::draw(model, view_, settings_, options(), image, stats); });
  }

  const Scene& scene_;
  unsigned threads_;
  csgcore::FrameSettings settings_;
  View view_;
  std::unique_ptr<Solid> solid_;
  std::unique_ptr<Subdivision> subdivision_;
  Image by_tiles_, by_cells_;
};

json row_of(const SceneFamily& family, uint32_t primitives, const Settings& settings,
            double& pass_ms) {
  const std::string name = std::string(family.name) + " of " + std::to_string(primitives);
  say(name);
  const PeakMemory memory;
  const Scene scene = family.make(primitives);
  std::unique_ptr<Drawn> drawn;
  pass_ms = frame_benchmark::time_ms([&] {
    drawn = std::make_unique<Drawn>(scene, PictureSize{}, settings.threads);
    drawn->draw_by_tiles();
    drawn->draw_by_cells();
  });
  const std::optional<uint64_t> peak = memory.bytes();
  drawn->require_right(name);
  // One after the other, since each prepares what the next ones need.
  const Timed works[] = {[&] { return drawn->prepare(); }, [&] { return drawn->subdivide(); },
                         [&] { return drawn->draw_by_tiles(); },
                         [&] { return drawn->draw_by_cells(); }};
  const std::vector<Summary> times = measure_in_turn(works, repetitions_of(settings, pass_ms));
  const Subdivision& subdivision = drawn->subdivision();
  return {{"primitives", scene.primitives.size()},
          {"prepare_ms", times[0]},
          {"subdivide_ms", times[1]},
          {"first_ms", times[2]},
          {"steady_ms", times[3]},
          {"cells", subdivision.nodes().size()},
          {"leaves", subdivision.leaves().size()},
          {"subdivision_bytes", subdivision.bytes()},
          {"peak_bytes", peak ? json(*peak) : json()}};
}

json grow(const SceneFamily& family, const Settings& settings, LeftOut& left_out) {
  json rows = json::array();
  const uint32_t most = settings.quick ? 100 : settings.most_primitives;
  double pass_ms = 0, growth = 10;
  for (uint64_t primitives = 10; primitives <= most; primitives *= 10) {
    if (pass_ms * growth > kMostPass_ms) {
      left_out.add(std::string(family.title) + " from " + std::to_string(primitives),
                   "would take longer than " + std::to_string(int(kMostPass_ms / 1'000)) +
                       " s to prepare, subdivide and draw");
      break;
    }
    const double before_ms = pass_ms;
    rows.push_back(row_of(family, static_cast<uint32_t>(primitives), settings, pass_ms));
    if (before_ms > 0) growth = std::max(10.0, pass_ms / before_ms);
  }
  return {{"family", family.name}, {"title", family.title}, {"rows", rows}};
}

json draw_unseen(const frame_benchmark::GrowthScene& growth, const Settings& settings) {
  constexpr uint32_t kUnseen = 99'000;
  using frame_benchmark::Subject;
  say(growth.name);
  const View& view = frame_benchmark::growth_view();
  const Subject alone(growth.make(0), view);
  const Subject grown(growth.make(settings.quick ? 900 : kUnseen), view);
  if (!frame_benchmark::agrees_with_reference(alone.scene(), view, alone.hits())) {
    throw WrongAnswer(std::string(growth.name) + ": not what the reference sees");
  }
  if (!frame_benchmark::sees_the_same(alone, grown)) {
    throw WrongAnswer(std::string(growth.name) + ": parts that cannot be seen change the picture");
  }
  const frame_benchmark::Drawing by_tiles{frame_benchmark::Method::kTiles, settings.threads};
  Image image;
  const Timed works[] = {timed([&] { alone.draw(by_tiles, image); }),
                         timed([&] { grown.draw(by_tiles, image); })};
  const std::vector<Summary> times = measure_in_turn(works, repetitions_of(settings, 0));
  return {{"scene", growth.name},
          {"alone_ms", times[0]},
          {"grown_ms", times[1]},
          {"ratio", times[1].median / times[0].median},
          {"least_ratio", times[1].least / times[0].least}};
}

const SceneFamily& family(const std::string& name) {
  const auto all = scene_families();
  return *std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
}

struct SceneOfSize {
  const char* family;
  uint32_t primitives;
  std::string name() const { return family + std::to_string(primitives); }
  Scene make() const { return measure::family(family).make(primitives + 1); }
};

json over_pixels(const SceneOfSize& subject, const Settings& settings) {
  say("pixels: " + subject.name());
  const Scene scene = subject.make();
  std::vector<double> megapixels{0.1, 0.2, 0.5, 1, 2, 4, 8};
  if (settings.quick) megapixels.resize(1);
  json rows = json::array();
  for (const double mega : megapixels) {
    // 4 : 3, as 640×480.
    const auto unit = static_cast<uint32_t>(std::lround(std::sqrt(mega * 1e6 / 12)));
    const PictureSize size{4 * unit, 3 * unit};
    Drawn drawn(scene, size, settings.threads);
    drawn.require_right(subject.name() + " of " + std::to_string(mega) + " megapixels");
    const Timed works[] = {[&] { return drawn.draw_by_tiles(); },
                           [&] { return drawn.draw_by_cells(); }};
    const std::vector<Summary> times = measure_in_turn(works, repetitions_of(settings, 0));
    rows.push_back({{"width_px", size.width_px},
                    {"height_px", size.height_px},
                    {"first_ms", times[0]},
                    {"steady_ms", times[1]}});
  }
  return {{"scene", subject.name()}, {"rows", rows}};
}

json over_threads(const SceneOfSize& subject, const Settings& settings) {
  constexpr PictureSize kSize{1920, 1080};
  say("threads: " + subject.name());
  const Scene scene = subject.make();
  json rows = json::array();
  for (unsigned threads = 1; threads <= static_cast<unsigned>(get_nprocs()); ++threads) {
    Drawn drawn(scene, kSize, threads);
    drawn.require_right(subject.name() + " by " + std::to_string(threads) + " threads");
    const Timed works[] = {[&] { return drawn.subdivide(); }, [&] { return drawn.draw_by_tiles(); },
                           [&] { return drawn.draw_by_cells(); }};
    const std::vector<Summary> times = measure_in_turn(works, repetitions_of(settings, 0));
    rows.push_back({{"threads", threads},
                    {"subdivide_ms", times[0]},
                    {"first_ms", times[1]},
                    {"steady_ms", times[2]}});
  }
  return {{"scene", subject.name()},
          {"width_px", kSize.width_px},
          {"height_px", kSize.height_px},
          {"rows", rows}};
}

}  // namespace

json measure_scale(const Settings& settings) {
  LeftOut left_out;
  json primitives = json::array(), unseen = json::array(), pixels = json::array(),
       threads = json::array();
  for (const SceneFamily& one : scene_families()) {
    primitives.push_back(grow(one, settings, left_out));
  }
  for (const auto& growth : frame_benchmark::growth_scenes()) {
    unseen.push_back(draw_unseen(growth, settings));
    if (settings.quick) break;
  }
  std::vector<SceneOfSize> subjects{{"cs", 1'000}, {"cs", 10'000}, {"cc", 1'000}};
  if (settings.quick) subjects = {{"cs", 100}};
  for (const SceneOfSize& subject : subjects) {
    pixels.push_back(over_pixels(subject, settings));
    threads.push_back(over_threads(subject, settings));
  }
  return {{"width_px", PictureSize{}.width_px},
          {"height_px", PictureSize{}.height_px},
          {"threads", settings.threads},
          {"primitives", primitives},
          {"unseen", unseen},
          {"pixels", pixels},
          {"threads_rows", threads},
          {"left_out", left_out.reasons}};
}

}  // namespace measure
