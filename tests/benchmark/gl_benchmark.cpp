// Times a frame of OpenGL's two techniques, frame by frame in turn, by OpenSCAD's default camera:
//   GALLIUM_DRIVER=llvmpipe gl_benchmark
// It prints medians of the frames, in ms. …_ms is a whole frame without reading it back, and, for
// tiles, the part of it that the lists and their upload take. …_cpu_ms is the processor time of all
// threads, reading back included; it does not depend on other programs. …_wrong counts the pixels
// that differ from the CPU's, in hit or miss or by 1e-4 of the model's size.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <memory>
#include <string>

#include "frame.hpp"
#include "glrender/fixture.hpp"
#include "glrender/renderer.hpp"
#include "named_design.hpp"

namespace {

using csgcore::Image;
using csgcore::Scene;
using csgcore::Solid;
using frame_benchmark::Design;
using frame_benchmark::Subject;
using glrender::FrameStats;
using glrender::Technique;

double cpu_ms(std::clock_t ticks) { return 1e3 * static_cast<double>(ticks) / CLOCKS_PER_SEC; }

class Medians {
 public:
  void add(const std::string& name, double value) { values_[name].push_back(value); }
  void report(benchmark::State& state) {
    for (auto& [name, values] : values_) {
      const auto middle = values.begin() + static_cast<long>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      state.counters[name] = *middle;
    }
  }

 private:
  std::map<std::string, std::vector<double>> values_;
};

void draw_frames(benchmark::State& state, const std::string& name) {
  Design design = frame_benchmark::make_design(name);
  const Subject subject(std::move(design.scene), frame_benchmark::default_view(design.view_box));
  glrender::Renderer renderer(gl_test::context(), subject.solid());
  renderer.load(subject.subdivision());
  glrender::FrameSettings settings;
  const auto draw = [&](Technique technique, bool measured, FrameStats& stats) {
    settings.technique = technique;
    settings.measured_channels = measured;
    return renderer.draw(subject.view(), settings, stats);
  };

  Image cpu;
  csgcore::TraceStats traced;
  settings.measured_channels = true;
  csgcore::draw(subject.solid(), subject.view(), settings, {}, cpu, traced);
  FrameStats cells, tiles;
  for (const auto technique : {Technique::kCells, Technique::kTiles}) {
    const auto differences =
        gl_test::compare(draw(technique, true, cells), cpu, subject.solid().bounds().diagonal());
    const std::string prefix = technique == Technique::kCells ? "cells_" : "tiles_";
    state.counters[prefix + "wrong"] = static_cast<double>(differences.wrong());
    state.counters[prefix + "other_id"] = static_cast<double>(differences.id);
    if (differences.wrong() * 1000 > differences.hits) {
      frame_benchmark::give_up(prefix + "picture of " + name + ": " + differences.first);
    }
    draw(technique, false, cells);  // compiles the shaders
  }
  Medians medians;
  for (auto _ : state) {
    const std::clock_t start = std::clock();
    draw(Technique::kCells, false, cells);
    const std::clock_t middle = std::clock();
    draw(Technique::kTiles, false, tiles);
    medians.add("cells_cpu_ms", cpu_ms(middle - start));
    medians.add("tiles_cpu_ms", cpu_ms(std::clock() - middle));
    medians.add("cells_ms", cells.traverse_ms + cells.draw_ms);
    medians.add("cells_read_ms", cells.read_ms);
    medians.add("tiles_ms", tiles.list_ms + tiles.traverse_ms + tiles.draw_ms);
    medians.add("tiles_list_ms", tiles.list_ms);
    medians.add("tiles_upload_ms", tiles.traverse_ms);
    medians.add("tiles_read_ms", tiles.read_ms);
  }
  medians.report(state);
  state.counters["tiles"] = static_cast<double>(tiles.tiles_drawn);
}

}  // namespace

int main(int argc, char** argv) {
  for (const char* name : {"CS1000", "CS10000", "CC1000", "t1022", "r9"}) {
    benchmark::RegisterBenchmark(name,
                                 [name](benchmark::State& state) { draw_frames(state, name); })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(10);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
