// Times the mesh kernel: operands in memory → a closed mesh. Before any time is taken, the volume
// is checked; volume_error is its error as a share. The time that Google Benchmark prints is the
// mean; median_ms and least_ms are of all iterations, cpu_ms adds up all threads; million_per_s is
// of input triangles. For one scene:
//   mesh_benchmark --benchmark_filter=CS1000/ --benchmark_min_time=5
#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/worker_threads.hpp"
#include "csgcore/boundary_mesh.hpp"
#include "csgcore/facets.hpp"
#include "csgcore/scene.hpp"
#include "support/mesh_judge.hpp"
#include "support/models.hpp"
#include "support/random_solids.hpp"
#include "times.hpp"

namespace {

using csgcore::BoundaryMesh;
using csgcore::CsgTree;
using csgcore::CsgTreeBuilder;
using csgcore::Op;
using csgcore::TriangleSet;
using csgcore::Vec3;
using test_support::MeshParts;
using timing::Times;

/// The first operand minus all others, or the union of all.
struct Subject {
  std::vector<TriangleSet> operands;
  bool is_difference = false;
  double volume = 0;  // of a union

  CsgTree tree(Op first, Op others) const {
    CsgTreeBuilder builder;
    builder.open(first);
    builder.primitive(0);
    builder.open(others);
    for (uint32_t i = 1; i < operands.size(); ++i) builder.primitive(i);
    builder.close();
    builder.close();
    return builder.finish();
  }
  CsgTree tree() const { return tree(is_difference ? Op::kDifference : Op::kUnion, Op::kUnion); }
};

Subject shifted_balls(int fragments) {
  const MeshParts ball = test_support::parts_of(csgcore::sphere_mesh(10, fragments));
  return {{test_support::surface_of(ball), test_support::surface_of(ball.moved({7, 0.3, 0.2}))},
          true};
}

/// A ball minus itself, moved by a share of its diameter: what is left is a sickle so thin.
Subject sickle(double share) {
  const MeshParts ball = test_support::parts_of(csgcore::sphere_mesh(10, 48));
  const Vec3 step = 20 * share * Vec3(0.6, 0.48, 0.64);
  return {{test_support::surface_of(ball), test_support::surface_of(ball.moved(step))}, true};
}

/// CSn with OpenSCAD's facets.
Subject cylinder_minus_spheres(uint32_t n) {
  constexpr int kFragments = 48;
  Subject subject{{}, true};
  for (const csgcore::Primitive& primitive : test_support::cylinder_minus_spheres(n).primitives) {
    MeshParts parts = test_support::parts_of(csgcore::faceted_mesh(primitive, kFragments));
    for (Vec3& vertex : parts.vertices) vertex = primitive.local_to_world.point(vertex);
    subject.operands.push_back(test_support::surface_of(parts));
  }
  return subject;
}

/// Unit cubes in rows and layers, so many steps apart.
Subject cubes(uint32_t n, double step) {
  Subject subject{{}, false, double(n)};
  const auto side = static_cast<uint32_t>(std::lround(std::cbrt(n)));
  for (uint32_t i = 0; i < n; ++i) {
    const Vec3 min = step * Vec3(i % side, i / side % side, i / side / side);
    subject.operands.push_back(test_support::surface_of(test_support::box_parts(min, min + 1.0)));
  }
  return subject;
}

/// Returns the error of the volume as a share: of a difference, it and the intersection together
/// have that of the first operand. Gives up if that is large.
double volume_error(const Subject& subject) {
  constexpr double kMostError = 1e-9;
  const BoundaryMesh mesh = csgcore::boundary_mesh(subject.operands, subject.tree());
  if (csgcore::open_edges(mesh) != 0) timing::give_up("an open mesh");
  auto volume = double(test_support::volume_of(mesh));
  double expected = subject.volume;
  if (subject.is_difference) {
    const CsgTree common = subject.tree(Op::kIntersection, Op::kUnion);
    volume += double(test_support::volume_of(csgcore::boundary_mesh(subject.operands, common)));
    expected = double(test_support::volume_of(subject.operands[0]));
  }
  const double error = std::abs(volume - expected) / expected;
  if (!(error <= kMostError)) {
    timing::give_up("a volume of " + std::to_string(volume) + ", not " + std::to_string(expected));
  }
  return error;
}

struct Scene {
  const char* name;
  std::function<Subject()> make;
  double bar_ms;  // the bar for the median with two threads; 0: none
};

struct CheckedSubject {
  std::string name;
  Subject subject;
  double volume_error = 0;
};

const CheckedSubject& subject_of(const Scene& scene) {
  // One at a time, since the largest take a gigabyte.
  static CheckedSubject made;
  if (made.name != scene.name) {
    made = {scene.name, {}};
    made.subject = scene.make();
    made.volume_error = volume_error(made.subject);
  }
  return made;
}

void make_mesh(benchmark::State& state, const Scene& scene, unsigned threads) {
  const CheckedSubject& checked = subject_of(scene);
  const Subject& subject = checked.subject;
  const CsgTree tree = subject.tree();
  size_t triangles_in = 0;
  for (const TriangleSet& operand : subject.operands) triangles_in += operand.triangles.size();
  Times times;
  BoundaryMesh mesh;
  for (auto _ : state) {
    csgcore::with_threads(threads, [&] {
      times.measure([&] { mesh = csgcore::boundary_mesh(subject.operands, tree); });
    });
    state.SetIterationTime(times.last() / 1000);
  }
  timing::report(times, state);
  state.counters["in"] = static_cast<double>(triangles_in);
  state.counters["out"] = static_cast<double>(mesh.triangles.size());
  state.counters["volume_error"] = checked.volume_error;
  state.counters["million_per_s"] = static_cast<double>(triangles_in) / times.median() / 1000;
  if (scene.bar_ms > 0 && threads == 2) state.counters["of_bar"] = times.median() / scene.bar_ms;
}

void add_all() {
  const Scene scenes[] = {
      {"balls_25k", [] { return shifted_balls(158); }, 45},
      {"balls_250k", [] { return shifted_balls(500); }, 300},
      {"CS100", [] { return cylinder_minus_spheres(100); }, 0},
      {"CS1000", [] { return cylinder_minus_spheres(1'000); }, 700},
      {"CS10000", [] { return cylinder_minus_spheres(10'000); }, 7'000},
      {"flush_cubes_160", [] { return cubes(160, 1); }, 15},
      {"sickle_1e-3", [] { return sickle(1e-3); }, 0},
      {"sickle_1e-6", [] { return sickle(1e-6); }, 0},
      {"sickle_1e-9", [] { return sickle(1e-9); }, 0},
      {"sickle_1e-12", [] { return sickle(1e-12); }, 0},
      {"separate_cubes_1000", [] { return cubes(1'000, 2); }, 0},
      {"separate_cubes_10000", [] { return cubes(10'000, 2); }, 0},
      {"separate_cubes_100000", [] { return cubes(100'000, 2); }, 0},
      {"separate_cubes_1000000", [] { return cubes(1'000'000, 2); }, 3'000},
  };
  for (const Scene& scene : scenes) {
    for (const unsigned threads : {1u, 2u}) {
      const std::string name = std::string(scene.name) + "/threads=" + std::to_string(threads);
      benchmark::RegisterBenchmark(
          name.c_str(), [=](benchmark::State& state) { make_mesh(state, scene, threads); })
          ->Unit(benchmark::kMillisecond)
          ->UseManualTime();
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
