// Measures the cost of parts that share faces, from 10 to 10,000 of them: equal ones, plates that
// are flush, prisms on one base, bars about one axis, flush pockets, an intersection of slabs.
// `prepare_ms` is once per file, `trace_ms` a frame of 640×480 by two threads; the time that Google
// Benchmark prints is their sum. At the end it prints for each kind the largest exponent of the
// growth from one number of parts to ten times as many. (Issue 19: at most 1.2.)
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "csgcore/polyhedron.hpp"
#include "frame.hpp"

namespace {

using namespace csgcore;
using frame_benchmark::Drawing;
using frame_benchmark::Times;

Primitive box(const Vec3& size, const Affine& to_world) {
  static const auto unit = Polyhedron::box({Vec3(0.0), Vec3(1.0)});
  Affine scaled = to_world;
  for (int axis = 0; axis < 3; ++axis) scaled.linear[axis] *= size[axis];
  return make_polyhedron(unit, scaled);
}

Affine at(const Vec3& place) { return {Mat3(1.0), place}; }

Affine turned(double radians) {
  const double c = std::cos(radians);
  const double s = std::sin(radians);
  return {Mat3{Vec3(c, s, 0), Vec3(-s, c, 0), Vec3(0, 0, 1)}, Vec3(0.0)};
}

/// Returns one of the places on a square of side 20, which are spread alike for any number of them.
Vec3 place(uint32_t i) {
  const auto share = [i](double step) { return std::fmod(step * i, 1.0); };
  return {20 * share(0.754877666), 20 * share(0.569840291), 0};
}

struct Kind {
  const char* name;
  Op op;
  std::function<Primitive(uint32_t i, uint32_t count)> part;
};

const Kind kKinds[] = {
    {"equal_cubes", Op::kUnion, [](uint32_t, uint32_t) { return box(Vec3(10), at(Vec3(0.0))); }},
    {"flush_plates", Op::kUnion,
     [](uint32_t i, uint32_t) {
       return box({60, 60, 5}, at(place(i)));
     }},
    {"prisms_on_one_base", Op::kUnion,
     [](uint32_t i, uint32_t count) {
       static const auto prism = Polyhedron::frustum(0, 1, 1, 1, 6);
       const double height = 4 + 6.0 * i / count;
       return make_polyhedron(
           prism, {Mat3{Vec3(10, 0, 0), Vec3(0, 10, 0), Vec3(0, 0, height)}, Vec3(0.0)});
     }},
    {"bars_about_one_axis", Op::kUnion,
     [](uint32_t i, uint32_t count) {
       return box({40, 4, 4}, compose(turned(3.14159265358979 * i / count), at({-20, -2, 0})));
     }},
    {"flush_pockets", Op::kDifference,
     [](uint32_t i, uint32_t) {
       if (i == 0) return box({30, 30, 10}, at({-2, -2, 0}));
       return box({4, 4, 5}, at(place(i) + Vec3(0, 0, 5)));
     }},
    {"slabs_in_common", Op::kIntersection,
     [](uint32_t i, uint32_t) {
       return box({60, 60, 5}, at(-0.5 * place(i)));
     }},
};

Scene scene_of(const Kind& kind, uint32_t count) {
  Scene scene;
  CsgTreeBuilder builder;
  builder.open(kind.op);
  for (uint32_t i = 0; i < count; ++i) {
    scene.primitives.push_back(kind.part(i, count));
    scene.primitives.back().id = i;
    builder.primitive(i);
  }
  builder.close();
  scene.model = builder.finish();
  return scene;
}

std::map<std::string, std::map<uint32_t, double>> sums_ms;

void draw(benchmark::State& state, const Kind& kind, uint32_t count) {
  const Scene scene = scene_of(kind, count);
  const Box bounds = Solid(canonical_primitives(scene), scene.model).bounds();
  const View view = frame_benchmark::default_view(bounds);
  const Drawing drawing;
  std::unique_ptr<frame_benchmark::Subject> subject;
  Times prepare, trace;
  Image image;
  TraceStats stats;
  for (auto _ : state) {
    prepare.measure([&] { subject = std::make_unique<frame_benchmark::Subject>(scene, view); });
    trace.measure([&] { stats = subject->draw(drawing, image); });
    state.SetIterationTime((prepare.last() + trace.last()) / 1000);
  }
  frame_benchmark::AnswerCheck(*subject).require_right(drawing);
  frame_benchmark::report(stats, state);
  state.counters["prepare_ms"] = prepare.median();
  state.counters["trace_ms"] = trace.median();
  sums_ms[kind.name][count] = prepare.median() + trace.median();
}

void report_growth() {
  for (const auto& [name, sums] : sums_ms) {
    double steepest = 0;
    for (auto next = sums.begin(), earlier = next++; next != sums.end(); earlier = next++) {
      steepest =
          std::max(steepest, std::log(next->second / earlier->second) /
                                 std::log(static_cast<double>(next->first) / earlier->first));
    }
    std::printf("%s: grows by the power %.2f at most\n", name.c_str(), steepest);
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  for (const Kind& kind : kKinds) {
    for (const uint32_t count : {10u, 100u, 1'000u, 10'000u}) {
      const std::string name = std::string(kind.name) + "/" + std::to_string(count);
      benchmark::RegisterBenchmark(
          name.c_str(), [&kind, count](benchmark::State& state) { draw(state, kind, count); })
          ->Unit(benchmark::kMillisecond)
          ->UseManualTime();
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  report_growth();
}
