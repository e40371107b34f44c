// Tests drawing a scene repeatedly: every picture equals that of render().
#include "frontend/scene_renderer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "csgcore/solid.hpp"
#include "csgcore/subdivision.hpp"
#include "frontend/camera.hpp"
#include "frontend/error.hpp"
#include "frontend/render.hpp"
#include "support/models.hpp"

namespace frontend {
namespace {

using csgcore::Hits;
using csgcore::Image;
using csgcore::Projection;
using csgcore::Scene;
using csgcore::Vec3;
using ScenePointer = std::shared_ptr<const Scene>;

ScenePointer lattice(uint32_t seed = 1) {
  return std::make_shared<const Scene>(test_support::cylinder_minus_spheres(60, seed));
}

/// Views lattice() enlarged by `size`.
csgcore::View view_of(double turn_deg = 25, Projection projection = Projection::kPerspective,
                      double size = 1) {
  CameraOptions options;
  options.projection = projection;
  options.width_px = 120;
  options.height_px = 90;
  return make_view({Vec3(0), {55, 0, turn_deg}, 90 * size}, options);
}

RenderSettings settings_of(RendererKind renderer, Technique technique = Technique::kAuto) {
  RenderSettings settings;
  settings.renderer = renderer;
  settings.technique = technique;
  settings.measured_channels = true;
  return settings;
}

/// Cells along rims that no division separates are counted, and drawn.
TEST(SceneRenderer, CountsTheCellsThatWereGivenUp) {
  const auto scene = std::make_shared<const Scene>(test_support::stacked_frusta(100));
  CameraOptions camera;
  camera.width_px = 640;
  camera.height_px = 480;
  const csgcore::View view = make_view({Vec3(0, 0, 25), {55, 0, 25}, 180}, camera);
  const auto draw = [&](Technique technique, RenderStats& stats) {
    RenderSettings settings;
    settings.renderer = RendererKind::kCpu;
    settings.technique = technique;
    settings.leaf_primitives = 2;
    settings.threshold_px = 1;
    SceneRenderer renderer;
    renderer.load(scene);
    return renderer.draw(view, settings, stats);
  };
  RenderStats cells, tiles;
  draw(Technique::kCells, cells);
  EXPECT_GT(cells.leaves_given_up, 0u);
  EXPECT_LT(cells.leaves_given_up, cells.leaves);
  EXPECT_LE(cells.bytes, csgcore::subdivision_budget(200));
  draw(Technique::kTiles, tiles);
  EXPECT_EQ(tiles.leaves_given_up, 0u);
}

void expect_same(const Image& a, const Image& b) {
  EXPECT_TRUE(a.rgb == b.rgb);
  EXPECT_TRUE(a.z == b.z);
  EXPECT_TRUE(a.id == b.id);
}

struct Method {
  const char* name;
  RenderSettings settings;
};

class EveryMethod : public testing::TestWithParam<Method> {
 protected:
  void SetUp() override {
    if (settings_.renderer != RendererKind::kGl) return;
    try {
      RenderStats stats;
      render(*lattice(), view_of(), settings_, stats);
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
  /// To be called before the first draw of `renderer_`, since a thread has one OpenGL context.
  Image rendered(const Scene& scene, const csgcore::View& view) {
    RenderStats stats;
    return render(scene, view, settings_, stats);
  }
  RenderSettings settings_ = GetParam().settings;
  RenderStats stats_;
  SceneRenderer renderer_;
};

INSTANTIATE_TEST_SUITE_P(
    SceneRenderer, EveryMethod,
    testing::Values(Method{"Tiles", settings_of(RendererKind::kCpu, Technique::kTiles)},
                    Method{"Cells", settings_of(RendererKind::kCpu, Technique::kCells)},
                    Method{"GlTiles", settings_of(RendererKind::kGl, Technique::kTiles)},
                    Method{"GlCells", settings_of(RendererKind::kGl, Technique::kCells)}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_P(EveryMethod, DrawsAgainAndAgain) {
  const ScenePointer scene = lattice();
  std::vector<csgcore::View> views;
  for (const double turn_deg : {25.0, 25.0, 120.0, 25.0}) {
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      views.push_back(view_of(turn_deg, projection));
    }
  }
  std::vector<Image> wanted;
  for (const csgcore::View& view : views) wanted.push_back(rendered(*scene, view));
  renderer_.load(scene);
  for (std::size_t i = 0; i < views.size(); ++i) {
    expect_same(renderer_.draw(views[i], settings_, stats_), wanted[i]);
  }
}

TEST_P(EveryMethod, AStudioIsLitAlike) {
  const ScenePointer scene = lattice();
  settings_.measured_channels = true;
  renderer_.load(scene);
  const Image plain = renderer_.draw(view_of(), settings_, stats_);
  settings_.shading = Shading::kStudio;
  settings_.samples = kStudioSamples;
  const Image image = renderer_.draw(view_of(), settings_, stats_);
  EXPECT_EQ(image.z, plain.z);
  EXPECT_EQ(image.id, plain.id);
  RenderSettings by_cpu = settings_of(RendererKind::kCpu, Technique::kTiles);
  by_cpu.shading = Shading::kStudio;
  by_cpu.samples = kStudioSamples;
  const Image wanted = render(*scene, view_of(), by_cpu, stats_);
  double sum = 0, darker = 0;
  for (std::size_t pixel = 0; pixel < wanted.rgb.size(); ++pixel) {
    sum += std::abs(image.rgb[pixel][0] - wanted.rgb[pixel][0]);
    darker += std::max(0, plain.rgb[pixel][0] - image.rgb[pixel][0]);
  }
  EXPECT_LE(sum, 2.0 * static_cast<double>(wanted.rgb.size()));
  EXPECT_GT(darker, 5.0 * static_cast<double>(wanted.rgb.size()));
}

TEST_P(EveryMethod, WhatWasMadeOnceTakesNoTimeAgain) {
  renderer_.load(lattice());
  renderer_.draw(view_of(), settings_, stats_);
  EXPECT_GT(stats_.prepare_ms, 0);
  renderer_.draw(view_of(), settings_, stats_);
  EXPECT_EQ(stats_.prepare_ms, 0);
  EXPECT_EQ(stats_.context_ms, 0);
}

TEST_P(EveryMethod, DrawsWhatWasLoadedLast) {
  const ScenePointer scenes[] = {lattice(1), lattice(2), lattice(1)};
  std::vector<Image> wanted;
  for (const ScenePointer& scene : scenes) wanted.push_back(rendered(*scene, view_of()));
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    renderer_.load(scenes[i]);
    expect_same(renderer_.draw(view_of(), settings_, stats_), wanted[i]);
  }
  renderer_.load(std::make_shared<const Scene>());
  const Image empty = renderer_.draw(view_of(), settings_, stats_);
  EXPECT_EQ(empty.id, std::vector<uint32_t>(120 * 90, csgcore::kNoPrimitive));
}

TEST_P(EveryMethod, OtherSettingsInBetween) {
  const ScenePointer scene = lattice();
  std::vector<RenderSettings> all;
  for (const Show show : {Show::kSurface, Show::kCells, Show::kSurface}) {
    for (const uint32_t leaf_primitives : {8u, 2u}) {
      all.push_back(settings_);
      all.back().show = show;
      all.back().leaf_primitives = leaf_primitives;
    }
  }
  std::vector<Image> wanted;
  for (const RenderSettings& settings : all) {
    wanted.push_back(render(*scene, view_of(), settings, stats_));
  }
  renderer_.load(scene);
  for (std::size_t i = 0; i < all.size(); ++i) {
    expect_same(renderer_.draw(view_of(), all[i], stats_), wanted[i]);
  }
}

TEST(SceneRenderer, ASceneThatCannotBeDrawnLeavesTheOneBefore) {
  SceneRenderer renderer;
  const ScenePointer scene = lattice();
  renderer.load(scene);
  const auto huge = std::make_shared<const Scene>(
      test_support::scene_of(csgcore::Op::kUnion, {csgcore::make_sphere(1e95)}));
  EXPECT_THROW(renderer.load(huge), Error);
  RenderStats stats, wanted_stats;
  const RenderSettings settings = settings_of(RendererKind::kCpu);
  expect_same(renderer.draw(view_of(), settings, stats),
              render(*scene, view_of(), settings, wanted_stats));
}

TEST(SceneRenderer, AStoppedPictureEndsEarly) {
  SceneRenderer renderer;
  const ScenePointer scene = lattice();
  renderer.load(scene);
  for (const Technique technique : {Technique::kTiles, Technique::kCells}) {
    RenderSettings settings = settings_of(RendererKind::kCpu, technique);
    RenderStats whole, stopped;
    const Image wanted = renderer.draw(view_of(), settings, whole);
    std::stop_source source;
    source.request_stop();
    settings.stop = source.get_token();
    renderer.draw(view_of(), settings, stopped);
    EXPECT_LT(stopped.trace.rays, whole.trace.rays / 2);
    settings.stop = {};
    expect_same(renderer.draw(view_of(), settings, stopped), wanted);
  }
}

/// Returns the scene enlarged by `size` about the origin.
Scene resized(const Scene& scene, double size) {
  Scene result = scene;
  for (csgcore::Primitive& primitive : result.primitives) {
    primitive.local_to_world.linear *= size;
    primitive.local_to_world.translation *= size;
  }
  return result;
}

/// At pixels' centres, picking gives exactly the hits of a whole picture.
TEST(SceneRenderer, PicksWhatAPixelShows) {
  const ScenePointer scene = lattice();
  const csgcore::Solid solid(csgcore::canonical_primitives(*scene), scene->model);
  SceneRenderer renderer;
  renderer.load(scene);
  std::size_t found = 0;
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
    const csgcore::View view = view_of(25, projection);
    Hits hits;
    csgcore::TraceStats stats;
    csgcore::trace(solid, view, {}, hits, stats);
    const Hits picked = renderer.look(view);
    ASSERT_EQ(picked.primitive.size(), hits.primitive.size());
    for (uint32_t y = 0; y < view.height_px; y += 5) {
      for (uint32_t x = 0; x < view.width_px; x += 5) {
        const std::size_t i = std::size_t{y} * view.width_px + x;
        EXPECT_EQ(picked.primitive[i], hits.primitive[i]);
        if (hits.primitive[i] == Hits::kMiss) continue;
        ++found;
        EXPECT_LE(glm::length(picked.position[i] - hits.position[i]), 1e-11);
        EXPECT_LE(glm::length(picked.normal[i] - hits.normal[i]), 1e-11);
      }
    }
  }
  EXPECT_GT(found, 100u);
}

TEST(SceneRenderer, PicksInScenesOfAnySize) {
  for (const double size : {1e-30, 1e30}) {
    const auto scene = std::make_shared<const Scene>(resized(*lattice(), size));
    SceneRenderer plain, renderer;
    plain.load(lattice());
    renderer.load(scene);
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      const csgcore::View view = view_of(25, projection);
      const Hits wanted = plain.look(view);
      const Hits picked = renderer.look(view_of(25, projection, size));
      const std::size_t i = std::size_t{45} * view.width_px + 61;
      ASSERT_NE(wanted.primitive[i], Hits::kMiss);
      EXPECT_EQ(picked.primitive[i], wanted.primitive[i]);
      EXPECT_LE(glm::length(picked.position[i] / size - wanted.position[i]), 1e-11);
      EXPECT_LE(glm::length(picked.normal[i] - wanted.normal[i]), 1e-11);
    }
  }
}

}  // namespace
}  // namespace frontend
