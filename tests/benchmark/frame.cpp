#include "frame.hpp"

#include <cmath>
#include <random>
#include <utility>

#include "frontend/camera.hpp"
#include "support/reference.hpp"

namespace frame_benchmark {
namespace {

using csgcore::FrameSettings;
using csgcore::Hits;
using csgcore::Image;
using csgcore::Subdivision;
using csgcore::TraceOptions;
using csgcore::TraceStats;
using csgcore::View;

/// OpenSCAD's default colours. They are three different ones, so that pictures tell faces apart.
FrameSettings cornfield() {
  FrameSettings settings;
  settings.background = glm::vec3{0xff, 0xff, 0xe5} / 255.0f;
  settings.front = glm::vec3{0xf9, 0xd7, 0x2c} / 255.0f;
  settings.back = glm::vec3{0x9d, 0xcb, 0x51} / 255.0f;
  return settings;
}

/// Returns pixels that show something, and seeded ones of any kind: most wrong pixels of a wrong
/// answer are hits, but all of them may be missing.
std::vector<size_t> sampled_pixels(const Hits& hits) {
  constexpr size_t kHits = 80;
  constexpr size_t kAny = 40;
  std::vector<size_t> seen;
  for (size_t i = 0; i < hits.primitive.size(); ++i) {
    if (hits.primitive[i] != Hits::kMiss) seen.push_back(i);
  }
  std::mt19937 random(1);
  std::vector<size_t> sample;
  for (size_t i = 0; i < kHits && !seen.empty(); ++i) {
    sample.push_back(seen[random() % seen.size()]);
  }
  for (size_t i = 0; i < kAny; ++i) sample.push_back(random() % hits.primitive.size());
  return sample;
}

/// Returns whether some hundred pixels show what the reference does, unless that is undecided.
bool agrees_with_reference(const csgcore::Scene& scene, const csgcore::View& view,
                           const Hits& hits) {
  const csgcore::Reference reference(scene, view);
  const double far = csgcore::kReferencePositionError * reference.model_size();
  for (const size_t pixel : sampled_pixels(hits)) {
    const uint32_t x = static_cast<uint32_t>(pixel % hits.width_px);
    const uint32_t y = static_cast<uint32_t>(pixel / hits.width_px);
    const csgcore::ReferenceHit expected = reference.at(x, y);
    const bool same = hits.primitive[pixel] == expected.primitive &&
                      (!expected.hit() || std::abs(hits.s[pixel] - double(expected.s)) <= far);
    if (!same && !reference.undecided(x, y)) return false;
  }
  return true;
}

}  // namespace

std::string name_of(const Drawing& drawing) {
  const std::string method = drawing.method == Method::kTiles ? "tiles" : "cells";
  return method + "/threads=" + std::to_string(drawing.threads);
}

View default_view(const csgcore::Box& view_box, const PictureSize& size) {
  frontend::CameraOptions options;
  options.width_px = size.width_px;
  options.height_px = size.height_px;
  return frontend::make_view(frontend::choose_camera(options, view_box), options);
}

Subject::Subject(csgcore::Scene scene, const View& view)
    : scene_(std::move(scene)),
      view_(view),
      solid_(csgcore::canonical_primitives(scene_), scene_.model) {}

const Subdivision& Subject::subdivision() const {
  if (!subdivision_) {
    csgcore::SubdivisionOptions options;
    options.threads = 2;
    subdivide_ms_ = time_ms([&] { subdivision_ = std::make_unique<Subdivision>(solid_, options); });
  }
  return *subdivision_;
}

double Subject::subdivide_ms() const {
  subdivision();
  return subdivide_ms_;
}

TraceStats Subject::draw(const Drawing& drawing, Image& image) const {
  static const FrameSettings settings = cornfield();
  TraceOptions options;
  options.threads = drawing.threads;
  TraceStats stats;
  if (drawing.method == Method::kTiles) {
    csgcore::draw(solid_, view_, settings, options, image, stats);
  } else {
    csgcore::draw(subdivision(), view_, settings, options, image, stats);
  }
  return stats;
}

Hits Subject::hits() const {
  Hits hits;
  TraceStats stats;
  csgcore::trace(solid_, view_, TraceOptions{}, hits, stats);
  return hits;
}

void AnswerCheck::require_right(const Drawing& drawing) {
  if (first_.rgb.empty()) {
    if (!agrees_with_reference(subject_.scene(), subject_.view(), subject_.hits())) {
      give_up("not what the reference sees");
    }
    subject_.draw(Drawing{}, first_);
  }
  Image image;
  subject_.draw(drawing, image);
  if (image.rgb != first_.rgb) give_up(name_of(drawing) + " draws another picture");
}

void report(const TraceStats& stats, benchmark::State& state) {
  state.counters["rays"] = static_cast<double>(stats.rays);
  state.counters["intersections"] = static_cast<double>(stats.intersections);
  state.counters["tiles"] = static_cast<double>(stats.tiles);
  state.counters["resolved_rays"] = static_cast<double>(stats.resolved_rays);
  state.counters["cull_ms"] = stats.cull_ms;
}

}  // namespace frame_benchmark
