// Measures the cost of parts that cannot be seen: 1,000 primitives that can be seen are joined by
// up to 99,000 that are off the screen, hidden, inside the solid, cancelled by the operations or
// between the samples.
// Before any time is taken, the picture is checked: it must stay the same. Each iteration draws a
// frame of the 1,000 alone, too: `ratio`, `least_ratio` and `cpu_ratio` compare the medians, the
// minima and the processor's times of the two, taken at the same time. The time that Google
// Benchmark prints is the grown scene's. Bars for 99,000: 1.8 behind a body, 1.5 off screen or
// behind a wall.
#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "frame.hpp"
#include "growth_scenes.hpp"

namespace {

using csgcore::Image;
using csgcore::TraceStats;
using frame_benchmark::Drawing;
using frame_benchmark::GrowthScene;
using frame_benchmark::Method;
using frame_benchmark::Subject;
using frame_benchmark::Times;

struct Checked {
  explicit Checked(csgcore::Scene scene)
      : subject(std::move(scene), frame_benchmark::growth_view()), answer(subject) {}
  Subject subject;
  frame_benchmark::AnswerCheck answer;
};

/// Returns the scene, which is kept as long as benchmarks of the same kind of scene follow.
Checked& scene_of(const GrowthScene& growth, uint32_t unseen) {
  static const char* kept = nullptr;
  static std::map<uint32_t, std::unique_ptr<Checked>> scenes;
  if (kept != growth.name) scenes.clear();
  kept = growth.name;
  auto& scene = scenes[unseen];
  if (!scene) {
    scene = std::make_unique<Checked>(growth.make(unseen));
    const size_t expected = frame_benchmark::kVisiblePrimitives + unseen;
    if (scene->subject.scene().primitives.size() != expected) {
      frame_benchmark::give_up("primitives are missing");
    }
    if (unseen > 0 &&
        !frame_benchmark::sees_the_same(scene_of(growth, 0).subject, scene->subject)) {
      frame_benchmark::give_up("parts that cannot be seen change the picture");
    }
  }
  return *scene;
}

void grow(benchmark::State& state, const GrowthScene& growth, uint32_t unseen,
          const Drawing& drawing) {
  Checked* scenes[] = {&scene_of(growth, 0), &scene_of(growth, unseen)};
  Times times[2];
  TraceStats stats[2];
  Image image;
  for (Checked* scene : scenes) scene->answer.require_right(drawing);
  for (auto _ : state) {
    for (size_t i = 0; i < 2; ++i) {
      times[i].measure([&] { stats[i] = scenes[i]->subject.draw(drawing, image); });
      if (i == 1) state.SetIterationTime(times[i].last() / 1000);
    }
  }
  frame_benchmark::report(stats[1], state);
  state.counters["median_ms"] = times[1].median();
  state.counters["alone_ms"] = times[0].median();
  state.counters["ratio"] = times[1].median() / times[0].median();
  state.counters["least_ratio"] = times[1].least() / times[0].least();
  state.counters["cpu_ms"] = times[1].cpu();
  state.counters["cpu_ratio"] = times[1].cpu() / times[0].cpu();
  if (drawing.method == Method::kCells) {
    state.counters["subdivide_ms"] = scenes[1]->subject.subdivide_ms();
  }
}

void add(const GrowthScene& growth, uint32_t unseen, const Drawing& drawing) {
  const std::string name = std::string(growth.name) + "/" + std::to_string(unseen) + "/" +
                           frame_benchmark::name_of(drawing);
  benchmark::RegisterBenchmark(
      name.c_str(), [=](benchmark::State& state) { grow(state, growth, unseen, drawing); })
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime();
}

void add_all() {
  for (const GrowthScene& growth : frame_benchmark::growth_scenes()) {
    // Compares the scene with itself, which shows how much of a ratio is noise.
    for (const uint32_t unseen : {0u, 9'000u, 99'000u}) add(growth, unseen, {Method::kTiles, 2});
    add(growth, 99'000, {Method::kTiles, 1});
    add(growth, 99'000, {Method::kCells, 2});
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  add_all();
  benchmark::RunSpecifiedBenchmarks();
}
