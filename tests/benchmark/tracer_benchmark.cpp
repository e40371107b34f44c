// Times the CPU tracer: a tree in memory → a finished picture, by OpenSCAD's default camera. Before
// any time is taken, the picture is checked. The time that Google Benchmark prints is the mean;
// median_ms and least_ms are of all iterations, cpu_ms adds up all threads. On a machine that does
// other things as well:
//   tracer_benchmark --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "base/simd.hpp"
#include "frame.hpp"
#include "frontend/design_file.hpp"
#include "frontend/design_file_options.hpp"
#include "frontend/importer.hpp"
#include "support/models.hpp"

namespace {

using csgcore::Image;
using csgcore::Scene;
using csgcore::SimdLevel;
using csgcore::Solid;
using frame_benchmark::Drawing;
using frame_benchmark::Method;
using frame_benchmark::PictureSize;
using frame_benchmark::Subject;
using frame_benchmark::Times;

struct Design {
  Scene scene;
  csgcore::Box view_box;
};

Design read_example(const std::string& name) {
  frontend::DesignFileOptions reading;
  reading.evaluator = frontend::kDefaultEvaluator;
  reading.message = [](const std::string& line) { frame_benchmark::give_up(line); };
  reading.progress = [](const char*) {};
  frontend::DesignFile file =
      frontend::read_design(std::string(SCADRAY_EXAMPLES_DIR) + "/" + name + ".scad", reading);
  frontend::ImportedDesign design = frontend::import_design(file);
  return {std::move(design.scene), design.view_box};
}

/// Makes CSn or CCn in memory, or reads an example.
Design make_design(const std::string& name) {
  const std::string kind = name.substr(0, 2);
  if (kind != "CS" && kind != "CC") return read_example(name);
  const auto n = static_cast<uint32_t>(std::stoul(name.substr(2)));
  Scene scene = kind == "CS" ? test_support::cylinder_minus_spheres(n)
                             : test_support::cylinder_minus_cones(n);
  const csgcore::Solid solid(csgcore::canonical_primitives(scene), scene.model);
  return {std::move(scene), solid.bounds()};
}

struct Checked {
  Checked(Design design, const PictureSize& size)
      : subject(std::move(design.scene), frame_benchmark::default_view(design.view_box, size)),
        answer(subject) {}
  Subject subject;
  frame_benchmark::AnswerCheck answer;
};

/// Returns the design, which its benchmarks share.
Checked& design_of(const std::string& name, const PictureSize& size) {
  static std::map<std::pair<std::string, uint32_t>, std::unique_ptr<Checked>> designs;
  auto& design = designs[{name, size.width_px}];
  if (!design) design = std::make_unique<Checked>(make_design(name), size);
  return *design;
}

struct Run {
  std::string design;
  Drawing drawing;
  PictureSize size;
  SimdLevel widest = SimdLevel::kAvx512;
  bool fresh_image = false;
  double bar_ms = 0;  // the bar for the median; 0: none
};

void report_times(const Times& times, double bar_ms, benchmark::State& state) {
  frame_benchmark::report(times, state);
  if (bar_ms > 0) state.counters["of_bar"] = times.median() / bar_ms;
}

void draw_frames(benchmark::State& state, const Run& run) {
  csgcore::limit_simd_level(run.widest);
  Checked& design = design_of(run.design, run.size);
  design.answer.require_right(run.drawing);
  Times times;
  csgcore::TraceStats stats;
  Image reused;
  design.subject.draw(run.drawing, reused);
  for (auto _ : state) {
    times.measure([&] {
      Image fresh;
      stats = design.subject.draw(run.drawing, run.fresh_image ? fresh : reused);
    });
    state.SetIterationTime(times.last() / 1000);
  }
  frame_benchmark::report(stats, state);
  report_times(times, run.bar_ms, state);
  if (run.drawing.method == Method::kCells) {
    state.counters["subdivide_ms"] = design.subject.subdivide_ms();
  }
  csgcore::limit_simd_level(SimdLevel::kAvx512);
}

/// Does what is done once per file, between the import and the first picture.
void prepare(benchmark::State& state, const std::string& name) {
  const Scene scene = make_design(name).scene;
  Times times;
  for (auto _ : state) {
    std::unique_ptr<Solid> solid;
    times.measure([&] {
      solid = std::make_unique<Solid>(csgcore::canonical_primitives(scene), scene.model);
    });
    if (solid->primitives().size() != scene.primitives.size() || solid->bounds().empty()) {
      frame_benchmark::give_up("primitives are missing");
    }
    state.SetIterationTime(times.last() / 1000);
  }
  report_times(times, 0, state);
}

void add(const std::string& name, const Run& run) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State& state) { draw_frames(state, run); })
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime();
}

void add_frames(const std::string& design, double bar_ms) {
  for (const Method method : {Method::kTiles, Method::kCells}) {
    for (const unsigned threads : {1u, 2u}) {
      Run run;
      run.design = design;
      run.drawing = {method, threads};
      run.bar_ms = threads == 2 ? bar_ms : 0;
      add("frame/" + design + "/" + name_of(run.drawing), run);
    }
  }
}

void add_large_frames(const std::string& design, double bar_ms) {
  for (const Method method : {Method::kTiles, Method::kCells}) {
    Run run;
    run.design = design;
    run.drawing.method = method;
    run.size = {1920, 1080};
    run.bar_ms = bar_ms;
    add("frame_1920x1080/" + design + "/" + name_of(run.drawing), run);
  }
}

void add_fresh_image(const std::string& design) {
  Run run;
  run.design = design;
  run.fresh_image = true;
  add("fresh_image/" + design + "/" + name_of(run.drawing), run);
}

/// Adds the levels that this machine has.
void add_simd_levels(const std::string& design) {
  const std::pair<SimdLevel, const char*> levels[] = {{SimdLevel::kAvx512, "avx512"},
                                                      {SimdLevel::kAvx2, "avx2"},
                                                      {SimdLevel::kSse4, "sse4"},
                                                      {SimdLevel::kBaseline, "baseline"}};
  for (const auto& [level, name] : levels) {
    if (level < csgcore::simd_level()) continue;
    for (const Method method : {Method::kTiles, Method::kCells}) {
      Run run;
      run.design = design;
      run.drawing.method = method;
      run.widest = level;
      add("simd/" + design + "/" + name_of(run.drawing) + "/" + name, run);
    }
  }
}

void add_preparation(const std::string& design) {
  benchmark::RegisterBenchmark(("prepare/" + design).c_str(),
                               [=](benchmark::State& state) { prepare(state, design); })
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime();
}

void add_all() {
  struct Size {
    const char* design;
    double bar_ms;
  };
  const Size sizes[] = {{"CS100", 0},  {"CS1000", 2},  {"CS10000", 4}, {"CS100000", 25},
                        {"CC1000", 0}, {"CC10000", 6}, {"r9", 0},      {"t1022", 0}};
  for (const Size& size : sizes) {
    add_frames(size.design, size.bar_ms);
    add_fresh_image(size.design);
    add_preparation(size.design);
  }
  add_large_frames("CS1000", 12);
  add_simd_levels("CS1000");
  add_simd_levels("CC1000");
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  add_all();
  benchmark::RunSpecifiedBenchmarks();
}
