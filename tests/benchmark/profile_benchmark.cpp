// Times extruded and revolved profiles at 640×480 by two threads: from the list of edges in memory
// to the first picture (the profiles and the solid included), and further frames. Before any time
// is taken, the pictures by tiles and by cells are compared with each other. (Issue 23: a vase of
// 100 points in 15 ms, 20 lines of text in 10 ms, the first picture of a polygon of 6,000 points in
// 20 ms.)
#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "csgcore/profile.hpp"
#include "frame.hpp"
#include "models.hpp"

namespace {

using namespace csgcore;
using frame_benchmark::Drawing;
using frame_benchmark::Method;
using frame_benchmark::Subject;
using frame_benchmark::Times;
using Kind = ProfileEdge::Kind;

std::shared_ptr<const Profile> filled(std::vector<ProfileLoop> loops) {
  return std::make_shared<Profile>(std::move(loops), FillRule::kNonZero);
}

/// A wall of 100 points, half of them outside.
std::vector<Primitive> vase() {
  constexpr int kPoints = 50;
  ProfileLoop loop;
  const auto radius = [](double y) { return 6 + 3 * std::sin(0.35 * y) + 0.1 * y; };
  for (int i = 0; i < kPoints; ++i) {
    const double y = 20.0 * i / (kPoints - 1);
    loop.push_back({Kind::kLine, true, {radius(y), y}, {}});
  }
  for (int i = kPoints - 1; i >= 0; --i) {
    const double y = 20.0 * i / (kPoints - 1);
    loop.push_back({Kind::kLine, true, {radius(y) - 0.5, y}, {}});
  }
  return {make_revolution(filled({loop}))};
}

/// Returns a ring of quadratic curves about a centre, as the bowl of a letter has.
ProfileLoop ring(const Vec2& center, const Vec2& radii, bool is_counterclockwise) {
  constexpr int kCurves = 8;
  ProfileLoop loop;
  const auto at = [&](double turns, double stretch) {
    const double angle = (is_counterclockwise ? 2 : -2) * std::numbers::pi * turns;
    return Vec2{center.x + stretch * radii.x * std::cos(angle),
                center.y + stretch * radii.y * std::sin(angle)};
  };
  for (int i = 0; i < kCurves; ++i) {
    loop.push_back({Kind::kBezier, true, at((i + 1.0) / kCurves, 1),
                    at((i + 0.5) / kCurves, 1 / std::cos(std::numbers::pi / kCurves))});
  }
  return loop;
}

/// 20 lines of 40 letters with a bowl and a stem.
std::vector<Primitive> text() {
  constexpr int kLines = 20, kLetters = 40;
  std::vector<Primitive> lines;
  for (int line = 0; line < kLines; ++line) {
    std::vector<ProfileLoop> loops;
    for (int letter = 0; letter < kLetters; ++letter) {
      const Vec2 corner{8.0 * letter, -12.0 * line};
      loops.push_back(ring(corner + Vec2{3, 3}, {3, 3}, true));
      loops.push_back(ring(corner + Vec2{3, 3}, {2, 2}, false));
      ProfileLoop stem;
      for (const Vec2& p : {Vec2{5.2, 0}, Vec2{6.2, 0}, Vec2{6.2, 8}, Vec2{5.2, 8}}) {
        stem.push_back({Kind::kLine, true, corner + p, {}});
      }
      loops.push_back(stem);
    }
    lines.push_back(make_extrusion(filled(loops), 0, 2));
  }
  return lines;
}

/// A gear of 6,000 points.
std::vector<Primitive> polygon() {
  constexpr int kPoints = 6000;
  ProfileLoop loop;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPoints;
    const double radius = 20 + 2 * std::sin(60 * angle) + 0.02 * (i % 2);
    loop.push_back({Kind::kLine, true, {radius * std::cos(angle), radius * std::sin(angle)}, {}});
  }
  return {make_extrusion(filled({loop}), 0, 5)};
}

struct Design {
  std::string name;
  std::function<std::vector<Primitive>()> make;
  Box view_box;
};

Scene scene_of(const Design& design) { return test_support::scene_of(Op::kUnion, design.make()); }

void draw_first(benchmark::State& state, const Design& design) {
  frame_benchmark::time_first_pictures(state, frame_benchmark::default_view(design.view_box),
                                       [&] { return scene_of(design); });
}

void draw_frames(benchmark::State& state, const Design& design, const Drawing& drawing) {
  static std::map<std::string, std::unique_ptr<Subject>> subjects;
  auto& subject = subjects[design.name];
  if (!subject) {
    subject =
        std::make_unique<Subject>(scene_of(design), frame_benchmark::default_view(design.view_box));
    frame_benchmark::require_agreement(*subject);
  }
  frame_benchmark::time_frames(state, *subject, drawing);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const Design designs[] = {{"vase", vase, {{-10, -10, 0}, {10, 10, 20}}},
                            {"text", text, {{0, -230, 0}, {320, 10, 2}}},
                            {"polygon", polygon, {{-22, -22, 0}, {22, 22, 5}}}};
  for (const Design& design : designs) {
    frame_benchmark::add("first/" + design.name,
                         [=](benchmark::State& state) { draw_first(state, design); });
    for (const Method method : {Method::kTiles, Method::kCells}) {
      const Drawing drawing{method, 2};
      frame_benchmark::add("frame/" + design.name + "/" + frame_benchmark::name_of(drawing),
                           [=](benchmark::State& state) { draw_frames(state, design, drawing); });
    }
  }
  benchmark::RunSpecifiedBenchmarks();
}
