// Measures the studio's light in a design's picture of 640 × 480 pixels, for
// tests/benchmark/studio.py:
//   benchmark_light FILE [REPETITIONS]
// Standard output is JSON:
// {"pixels": those judged, "shaded_ms": of a flat picture, by repetition,
//  "rests": [{"directions", "ms": from the prepared solid to the picture, by repetition,
//    "mean_error", "worst_error": in levels of 255 of a pixel's brightness}]}
// The picture is judged where a grid's pixels lie, as kJudgedDirections of the sky and of the key
// light give them. Rests are those of the window (frontend/viewer/painter.cpp).
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "csgcore/light_tracer.hpp"
#include "csgcore/primitive.hpp"
#include "csgcore/studio.hpp"
#include "csgcore/studio_light.hpp"
#include "csgcore/tracer.hpp"
#include "frontend/camera.hpp"
#include "painter.hpp"
#include "support/read_design.hpp"
#include "times.hpp"

namespace {

using csgcore::Hits;
using csgcore::Image;
using csgcore::Solid;
using csgcore::StudioSettings;
using csgcore::Vec3;
using csgcore::View;
using nlohmann::json;

constexpr uint32_t kWidth = 640, kHeight = 480;
constexpr uint32_t kBlock = 2;  // the picture is drawn in squares of pixels that become one
constexpr uint32_t kJudgedDirections = 4096;
// Every seventh pixel of every seventh row is judged: not all of them are at the same place of the
// squares within which pixels share light.
constexpr uint32_t kJudgedStep = 7;
constexpr unsigned kThreads = 2;
/// The key light is a disc of this radius at a distance of 1 (csgcore/NUMERICS.md, "Light").
constexpr double kKeyRadius = 0.06;

const double kGoldenTurn = std::numbers::pi * (3 - std::sqrt(5.0));

std::vector<Vec3> sky() {
  std::vector<Vec3> directions;
  for (uint32_t i = 0; i < kJudgedDirections; ++i) {
    const double z = 1 - (2.0 * i + 1) / kJudgedDirections, turn = kGoldenTurn * i;
    const double radius = std::sqrt(1 - z * z);
    directions.emplace_back(radius * std::cos(turn), radius * std::sin(turn), z);
  }
  return directions;
}

std::vector<Vec3> key_disc(const Vec3& middle, const Vec3& up) {
  const Vec3 across = glm::normalize(glm::cross(middle, up)), along = glm::cross(middle, across);
  std::vector<Vec3> directions;
  for (uint32_t i = 0; i < kJudgedDirections; ++i) {
    const double turn = kGoldenTurn * i;
    const double radius = kKeyRadius * std::sqrt((i + 0.5) / kJudgedDirections);
    directions.push_back(
        glm::normalize(middle + radius * (std::cos(turn) * across + std::sin(turn) * along)));
  }
  return directions;
}

/// Returns each point's share of the light that comes evenly from all of the directions.
std::vector<double> shares(const Solid& solid, const csgcore::SurfacePoints& points,
                           const std::vector<Vec3>& directions) {
  const csgcore::LightTracer tracer(solid);
  std::vector<uint8_t> lit(points.position.size());
  std::vector<double> all(lit.size()), open(lit.size());
  for (const Vec3& direction : directions) {
    tracer.find_lit(points, direction, lit);
    for (size_t i = 0; i < lit.size(); ++i) {
      const double weight = std::max(0.0, glm::dot(points.normal[i], direction));
      all[i] += weight;
      if (lit[i]) open[i] += weight;
    }
  }
  for (size_t i = 0; i < lit.size(); ++i) open[i] = all[i] > 0 ? open[i] / all[i] : 1;
  return open;
}

/// The exact picture at the judged pixels.
class Judge {
 public:
  Judge(const Solid& solid, const View& fine, const Image& unlit) {
    Hits hits;
    csgcore::TraceStats stats;
    csgcore::trace(solid, fine, {}, hits, stats);
    std::vector<Vec3> position, normal;
    std::vector<size_t> at;
    for (uint32_t y = 0; y < kHeight; y += kJudgedStep) {
      for (uint32_t x = 0; x < kWidth; x += kJudgedStep) {
        const Pixel pixel = pixel_at(x, y);
        for (const size_t i : pixel) {
          if (hits.primitive[i] == Hits::kMiss) continue;
          if (pixels_.empty() || pixels_.back() != pixel) pixels_.push_back(pixel);
          position.push_back(hits.position[i]);
          normal.push_back(hits.normal[i]);
          at.push_back(i);
        }
      }
    }
    const csgcore::StudioLight light = csgcore::studio_light(fine);
    const std::vector<double> open = shares(solid, {position, normal}, sky());
    const std::vector<double> key = shares(solid, {position, normal}, key_disc(light.key, fine.up));
    levels_.assign(unlit.rgb.size(), 0);
    for (size_t i = 0; i < levels_.size(); ++i) levels_[i] = unlit.rgb[i][0];
    for (size_t i = 0; i < at.size(); ++i) {
      levels_[at[i]] *= csgcore::studio_shade(light, normal[i], open[i], key[i]) /
                        csgcore::studio_shade(light, normal[i], 1, 1);
    }
  }

  size_t pixels() const { return pixels_.size(); }

  /// Returns the mean error and the worst, in levels.
  std::array<double, 2> errors(const Image& image) const {
    double sum = 0, worst = 0;
    for (const Pixel& pixel : pixels_) {
      double difference = 0;
      for (const size_t i : pixel) difference += image.rgb[i][0] - levels_[i];
      difference = std::abs(difference) / double(pixel.size());
      sum += difference;
      worst = std::max(worst, difference);
    }
    return {sum / double(std::max<size_t>(pixels_.size(), 1)), worst};
  }

 private:
  using Pixel = std::array<size_t, kBlock * kBlock>;  // places in the picture that is drawn

  static Pixel pixel_at(uint32_t x, uint32_t y) {
    Pixel pixel;
    for (uint32_t i = 0; i < pixel.size(); ++i) {
      pixel[i] = size_t{kBlock * y + i / kBlock} * kBlock * kWidth + kBlock * x + i % kBlock;
    }
    return pixel;
  }

  std::vector<Pixel> pixels_;
  std::vector<double> levels_;
};

json measure(const std::string& file, int repetitions) {
  csgcore::Scene scene = test_support::read_design(file).scene;
  for (csgcore::Primitive& primitive : scene.primitives) primitive.color.reset();
  const Solid solid(csgcore::canonical_primitives(scene), scene.model);
  frontend::CameraOptions camera;
  camera.width_px = kBlock * kWidth;
  camera.height_px = kBlock * kHeight;
  const View fine = frontend::make_view(frontend::choose_camera(camera, solid.bounds()), camera);
  csgcore::FrameSettings frame;
  frame.shading = csgcore::Shading::kStudio;
  csgcore::TraceOptions options;
  options.threads = kThreads;

  Image unlit;
  csgcore::TraceStats stats;
  const auto draw = [&] { csgcore::draw(solid, fine, frame, options, unlit, stats); };
  json shaded = json::array(), rests = json::array();
  for (int i = 0; i < repetitions; ++i) shaded.push_back(timing::time_ms(draw));
  const Judge judge(solid, fine, unlit);
  StudioSettings settings;
  settings.block_px = kBlock;
  for (const bool is_last : {false, true}) {
    if (is_last) {
      settings.directions = window::kLastDirections;
      settings.shares_light = false;
    } else {
      settings = window::first_light(scene, settings);
    }
    Image image;
    json times = json::array();
    for (int i = 0; i < repetitions; ++i) {
      times.push_back(timing::time_ms(
          [&] { csgcore::draw_studio(solid, fine, frame, settings, options, image, stats); }));
    }
    // Lines are no light.
    StudioSettings judged = settings;
    judged.edges = 0;
    image = unlit;
    csgcore::finish_studio(solid, fine, judged, options, image, stats);
    const auto [mean, worst] = judge.errors(image);
    rests.push_back({{"directions", settings.directions},
                     {"ms", times},
                     {"mean_error", mean},
                     {"worst_error", worst}});
  }
  return {{"pixels", judge.pixels()}, {"shaded_ms", shaded}, {"rests", rests}};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: benchmark_light FILE [REPETITIONS]\n";
    return 2;
  }
  try {
    std::cout << measure(argv[1], argc > 2 ? std::max(1, std::atoi(argv[2])) : 5).dump() << '\n';
  } catch (const std::exception& error) {
    std::cerr << argv[1] << ": " << error.what() << '\n';
    return 1;
  }
}
