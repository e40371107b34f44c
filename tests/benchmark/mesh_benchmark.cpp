// Times triangle meshes: from a list of triangles in memory to the first picture (the BVH and the
// solid included), and further frames of 640×480 by two threads. The mesh is a bumpy ball, alone
// and with three cylinders cut from it. Before any time is taken, the pictures by tiles and by
// cells are compared with each other. Where Embree is installed, its frame of the ball alone stands
// beside. (Issue 22: the cut ball of 100,000 triangles in 60 ms, further frames in 20 ms.)
#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "csgcore/triangle_mesh.hpp"
#include "frame.hpp"
#include "models.hpp"
#ifdef MEASURE_HAS_EMBREE
#include "embree_frame.hpp"
#endif

namespace {

using namespace csgcore;
using frame_benchmark::Drawing;
using frame_benchmark::Method;
using frame_benchmark::Subject;
using frame_benchmark::Times;

struct Triangles {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Triangle> triangles;
};

/// Returns a ball of about radius 10 with bumps, of about `count` triangles.
Triangles bumpy_ball(uint32_t count) {
  const uint32_t rings = static_cast<uint32_t>(std::sqrt(count / 4.0)), around = 2 * rings;
  Triangles ball;
  const auto add_vertex = [&](double polar, double azimuth) {
    const double radius = 10 + 0.3 * std::sin(40 * polar) * std::sin(20 * azimuth);
    ball.vertices.push_back({radius * std::sin(polar) * std::cos(azimuth),
                             radius * std::sin(polar) * std::sin(azimuth),
                             radius * std::cos(polar)});
  };
  add_vertex(0, 0);
  for (uint32_t ring = 1; ring < rings; ++ring) {
    for (uint32_t i = 0; i < around; ++i) {
      add_vertex(std::numbers::pi * ring / rings, 2 * std::numbers::pi * i / around);
    }
  }
  add_vertex(std::numbers::pi, 0);
  const uint32_t last = static_cast<uint32_t>(ball.vertices.size()) - 1;
  const auto vertex = [&](uint32_t ring, uint32_t i) {
    if (ring == 0) return 0u;
    return ring == rings ? last : 1 + (ring - 1) * around + i % around;
  };
  for (uint32_t ring = 0; ring < rings; ++ring) {
    for (uint32_t i = 0; i < around; ++i) {
      ball.triangles.push_back({vertex(ring, i), vertex(ring + 1, i), vertex(ring + 1, i + 1)});
      ball.triangles.push_back({vertex(ring, i), vertex(ring + 1, i + 1), vertex(ring, i + 1)});
    }
  }
  return ball;
}

Scene scene_of(const Triangles& ball, bool is_cut) {
  std::vector<Primitive> primitives{
      make_mesh(std::make_shared<TriangleMesh>(ball.vertices, ball.triangles))};
  const Mat3 along[] = {Mat3(1.0), Mat3(Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)),
                        Mat3(Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0))};
  if (is_cut) {
    for (const Mat3& axis : along) {
      primitives.push_back(make_frustum(-20, 20, 3, 3, {axis, Vec3(0.0)}));
    }
  }
  return test_support::scene_of(Op::kDifference, std::move(primitives));
}

const Box kViewBox{Vec3(-10.0), Vec3(10.0)};

std::string name_of(uint32_t count, bool is_cut) {
  return std::to_string(count) + (is_cut ? "/cut" : "/alone");
}

void draw_first(benchmark::State& state, uint32_t count, bool is_cut) {
  const Triangles ball = bumpy_ball(count);
  frame_benchmark::time_first_pictures(state, frame_benchmark::default_view(kViewBox),
                                       [&] { return scene_of(ball, is_cut); });
}

void build(benchmark::State& state, uint32_t count) {
  const Triangles ball = bumpy_ball(count);
  Times times;
  for (auto _ : state) {
    std::unique_ptr<TriangleMesh> mesh;
    times.measure([&] { mesh = std::make_unique<TriangleMesh>(ball.vertices, ball.triangles); });
    if (!mesh->is_closed()) frame_benchmark::give_up("the ball is open");
    state.SetIterationTime(times.last() / 1000);
  }
  frame_benchmark::report(times, state);
}

void draw_frames(benchmark::State& state, uint32_t count, bool is_cut, const Drawing& drawing) {
  static std::map<std::pair<uint32_t, bool>, std::unique_ptr<Subject>> subjects;
  auto& subject = subjects[{count, is_cut}];
  if (!subject) {
    subject = std::make_unique<Subject>(scene_of(bumpy_ball(count), is_cut),
                                        frame_benchmark::default_view(kViewBox));
    frame_benchmark::require_agreement(*subject);
  }
  frame_benchmark::time_frames(state, *subject, drawing);
}

#ifdef MEASURE_HAS_EMBREE
void draw_by_embree(benchmark::State& state, uint32_t count) {
  const Triangles ball = bumpy_ball(count);
  std::vector<measure::CutTriangle> triangles;
  for (const auto& [a, b, c] : ball.triangles) {
    triangles.push_back({{ball.vertices[a], ball.vertices[b], ball.vertices[c]}, 0});
  }
  const char is_cut[] = {0};
  const measure::EmbreeFrame frame(triangles, is_cut, 2);
  const View view = frame_benchmark::default_view(kViewBox);
  Image image;
  image.width_px = view.width_px;
  image.height_px = view.height_px;
  image.rgb.resize(size_t{view.width_px} * view.height_px);
  Times times;
  for (auto _ : state) {
    times.measure([&] { frame.draw(view, FrameSettings{}, image); });
    state.SetIterationTime(times.last() / 1000);
  }
  frame_benchmark::report(times, state);
  state.counters["build_ms"] = frame.build_ms();
}
#endif

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  for (const uint32_t count : {1000u, 10'000u, 100'000u, 1'000'000u}) {
    frame_benchmark::add("build/" + std::to_string(count),
                         [=](benchmark::State& state) { build(state, count); });
#ifdef MEASURE_HAS_EMBREE
    frame_benchmark::add("embree/" + std::to_string(count),
                         [=](benchmark::State& state) { draw_by_embree(state, count); });
#endif
    for (const bool is_cut : {false, true}) {
      const std::string name = name_of(count, is_cut);
      frame_benchmark::add("first/" + name,
                           [=](benchmark::State& state) { draw_first(state, count, is_cut); });
      for (const Method method : {Method::kTiles, Method::kCells}) {
        const Drawing drawing{method, 2};
        frame_benchmark::add(
            "frame/" + name + "/" + frame_benchmark::name_of(drawing),
            [=](benchmark::State& state) { draw_frames(state, count, is_cut, drawing); });
      }
    }
  }
  benchmark::RunSpecifiedBenchmarks();
}
