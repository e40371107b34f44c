// Times the subdivision (paper §2) of CSn and CCn. Before any time is taken, the answer is checked:
// at sampled points the leaves must hold what the scene's solid does.
//   subdivision_benchmark --benchmark_filter=CS1000 --benchmark_repetitions=9
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "csgcore/subdivision.hpp"
#include "support/models.hpp"

namespace {

using csgcore::Box;
using csgcore::Leaf;
using csgcore::LeafKind;
using csgcore::Solid;
using csgcore::Subdivision;
using csgcore::SubdivisionOptions;
using csgcore::Vec3;

enum class Model { kSpheres, kCones };

/// Returns the solid, which the benchmarks of one model share.
const Solid& solid_of(Model model, uint32_t n) {
  static std::map<std::pair<Model, uint32_t>, std::unique_ptr<Solid>> solids;
  auto& solid = solids[{model, n}];
  if (!solid) {
    const csgcore::Scene scene = model == Model::kSpheres ? test_support::cylinder_minus_spheres(n)
                                                          : test_support::cylinder_minus_cones(n);
    solid = std::make_unique<Solid>(csgcore::canonical_primitives(scene), scene.model);
  }
  return *solid;
}

SubdivisionOptions exact(uint32_t leaf_primitives, csgcore::SplitRule split, unsigned threads) {
  SubdivisionOptions options;
  options.leaf_primitives = leaf_primitives;
  options.split = split;
  options.threads = threads;
  return options;
}

/// Returns the paper's rule for a 640×480 picture that the model fills, with OpenSCAD's field of
/// view.
SubdivisionOptions paper(double threshold_px, unsigned threads) {
  csgcore::View view;
  view.eye = {0, -90, 0};
  view.forward = {0, 1, 0};
  view.up = {0, 0, 1};
  view.half_height = 0.198912;  // tan(22.5°/2)
  view.width_px = 640;
  view.height_px = 480;
  SubdivisionOptions options = SubdivisionOptions::paper(threshold_px, view);
  options.threads = threads;
  return options;
}

bool holds(const Subdivision& subdivision, const Leaf& leaf, const Vec3& point) {
  if (leaf.test_count == 0) return leaf.solid;
  return csgcore::evaluate(subdivision.tests_of(leaf), [&](uint32_t primitive) {
    return csgcore::contains(subdivision.solid().primitives()[primitive], point);
  });
}

/// Checks a point in every leaf of a sample.
bool is_right(const Subdivision& subdivision) {
  constexpr size_t kSampledLeaves = 2000;
  std::mt19937 random(1);
  const auto within = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const size_t step = std::max<size_t>(1, subdivision.leaves().size() / kSampledLeaves);
  for (size_t i = 0; i < subdivision.leaves().size(); i += step) {
    const Leaf& leaf = subdivision.leaves()[i];
    const Box& box = leaf.box;
    const Vec3 point{within(box.min.x, box.max.x), within(box.min.y, box.max.y),
                     within(box.min.z, box.max.z)};
    if (holds(subdivision, leaf, point) != subdivision.solid().contains(point)) return false;
  }
  return !subdivision.leaves().empty();
}

void run(benchmark::State& state, Model model, uint32_t n, const SubdivisionOptions& options) {
  const Solid& solid = solid_of(model, n);
  const Subdivision subdivision(solid, options);
  if (!is_right(subdivision)) {
    std::fprintf(stderr, "wrong answer: no times\n");
    std::exit(1);
  }
  for (auto _ : state) {
    Subdivision timed(solid, options);
    benchmark::DoNotOptimize(timed.leaves().data());
  }
  const csgcore::LeafCensus counts = csgcore::census(subdivision);
  const auto of_kind = [&](LeafKind kind) {
    return static_cast<double>(counts.by_kind[static_cast<size_t>(kind)]);
  };
  state.counters["leaves"] = static_cast<double>(counts.leaves());
  state.counters["tests"] = static_cast<double>(counts.tests);
  state.counters["empty"] = of_kind(LeafKind::kEmpty);
  state.counters["union"] = of_kind(LeafKind::kUnion);
  state.counters["pair"] = of_kind(LeafKind::kPair);
  state.counters["general"] = of_kind(LeafKind::kGeneral);
  state.counters["full"] = of_kind(LeafKind::kFull);
  state.counters["dropped"] = of_kind(LeafKind::kDropped);
  state.counters["given_up"] = of_kind(LeafKind::kGivenUp);
}

void add(const std::string& name, Model model, uint32_t n, const SubdivisionOptions& options) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State& state) { run(state, model, n, options); })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

void add_all() {
  struct Size {
    const char* name;
    Model model;
    uint32_t n;
  };
  const Size sizes[] = {{"CS1000", Model::kSpheres, 1000},
                        {"CS10000", Model::kSpheres, 10000},
                        {"CS100000", Model::kSpheres, 100000},
                        {"CC1000", Model::kCones, 1000},
                        {"CC10000", Model::kCones, 10000}};
  using csgcore::SplitRule;
  for (const Size& size : sizes) {
    const std::string name = size.name;
    add(name + "/K=8", size.model, size.n, exact(8, SplitRule::kSurfaceArea, 1));
    add(name + "/K=8/cyclic", size.model, size.n, exact(8, SplitRule::kCyclic, 1));
    add(name + "/K=4", size.model, size.n, exact(4, SplitRule::kSurfaceArea, 1));
    add(name + "/K=16", size.model, size.n, exact(16, SplitRule::kSurfaceArea, 1));
    add(name + "/paper", size.model, size.n, paper(1, 1));
    for (const unsigned threads : {2u, 4u}) {
      add(name + "/K=8/threads=" + std::to_string(threads), size.model, size.n,
          exact(8, SplitRule::kSurfaceArea, threads));
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  add_all();
  benchmark::RunSpecifiedBenchmarks();
}
