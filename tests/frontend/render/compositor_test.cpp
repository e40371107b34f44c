// Tests that layers drawn in one pass make the picture of layers that are drawn one by one.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "csgcore/changed_areas.hpp"
#include "csgcore/tracer.hpp"
#include "frontend/camera.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "frontend/render_settings.hpp"
#include "render/prepared_scene.hpp"
#include "render/solid_renderer.hpp"

namespace frontend {
namespace {

using csgcore::Image;

/// Draws the whole picture of each surface by itself.
class OneByOne final : public SolidRenderer {
 public:
  Image draw_model(const csgcore::Solid& solid, const csgcore::FrameSettings& frame,
                   const PictureRequest& request) override {
    return picture_of(solid, csgcore::Boundary::kFirst, frame, request);
  }
  void draw_layers(const LayerSurfaces& layers, const PictureRequest& request,
                   Compositor& compositor) override {
    for (uint32_t turn = 0; turn < layers.turns.size(); ++turn) {
      const csgcore::Surface& surface = layers.surfaces[layers.turns[turn]];
      const Image picture = picture_of(*surface.solid, surface.boundary, surface.frame, request);
      compositor.blend(turn, picture, csgcore::area_of(*surface.solid, request.view));
    }
  }
  void forget() override {}

 private:
  static Image picture_of(const csgcore::Solid& solid, csgcore::Boundary boundary,
                          const csgcore::FrameSettings& frame, const PictureRequest& request) {
    csgcore::TraceOptions options;
    options.boundary = boundary;
    Image image;
    csgcore::TraceStats stats;
    csgcore::draw(solid, request.view, frame, options, image, stats);
    request.stats.trace.rays += stats.rays;
    return image;
  }
};

/// Writes designs as the text of a .csg. Coordinates are whole numbers, so that many faces
/// coincide.
class RandomDesign {
 public:
  explicit RandomDesign(uint32_t seed) : random_(seed) {}

  std::string text(int depth) {
    std::string result;
    for (int i = 0; i < 3 + depth; ++i) result += node(depth);
    return result;
  }

 private:
  int below(int end) { return static_cast<int>(random_() % static_cast<uint32_t>(end)); }
  std::string number(int low, int high) { return std::to_string(low + below(high - low + 1)); }

  std::string primitive() {
    if (below(2) == 0) {
      return "cube(size=[" + number(1, 9) + "," + number(1, 9) + "," + number(1, 9) +
             "],center=true);";
    }
    if (below(2) == 0) return "sphere($fn=0,$fa=12,$fs=2,r=" + number(1, 6) + ");";
    return "cylinder($fn=0,$fa=12,$fs=2,h=" + number(1, 9) + ",r1=" + number(1, 5) +
           ",r2=" + number(0, 5) + ",center=true);";
  }

  std::string node(int depth) {
    constexpr const char* kModifiers[] = {"%", "#", "", "", "", "", ""};
    constexpr const char* kColors[] = {"1,0,0,0.5", "0,1,0,0.3", "0,0,1,0", "1,1,0,1"};
    constexpr const char* kOperations[] = {"difference", "union", "intersection", "difference"};
    std::string inner;
    if (depth == 0 || below(3) == 0) {
      inner = primitive();
    } else {
      inner = std::string(kOperations[below(4)]) + "(){";
      for (int i = 2 + below(3); i > 0; --i) inner += node(depth - 1);
      inner += "}";
    }
    if (below(2) == 0) inner = std::string("color([") + kColors[below(4)] + "]){" + inner + "}";
    return kModifiers[below(7)] + ("multmatrix([[1,0,0," + number(-5, 5)) + "],[0,1,0," +
           number(-5, 5) + "],[0,0,1," + number(-5, 5) + "],[0,0,0,1]]){" + inner + "}";
  }

  std::mt19937 random_;
};

class OnePass : public testing::TestWithParam<Technique> {};

TEST_P(OnePass, IsThePictureOfLayersOneByOne) {
  RenderSettings settings;
  settings.scheme = color_schemes().front();
  settings.technique = GetParam();
  uint64_t layers = 0, parts = 0, rays = 0, rays_one_by_one = 0;
  for (uint32_t seed = 0; seed < 60; ++seed) {
    const std::string text = RandomDesign(seed).text(1 + seed % 3);
    ImportOptions options;
    if (seed % 5 == 4) options.picture = PictureKind::kThrownTogether;
    settings.translucency = seed % 4 == 1 ? Translucency::kDepth : Translucency::kFile;
    const auto scene =
        std::make_shared<csgcore::Scene>(import_design(parse(text, "a.csg"), options).scene);
    CameraOptions camera;
    camera.width_px = 100;
    camera.height_px = 91;
    camera.projection =
        seed % 2 == 0 ? csgcore::Projection::kPerspective : csgcore::Projection::kOrthographic;
    camera.camera = Camera{};
    camera.camera->distance = 40;
    const csgcore::View view = make_view(*camera.camera, camera);
    const PreparedScene prepared(scene);
    const auto draw = [&](SolidRenderer& renderer, uint64_t& sum) {
      RenderStats stats;
      const Image image = prepared.draw(renderer, {view, settings, stats});
      sum += stats.trace.rays;
      return image;
    };
    OneByOne one_by_one;
    const Image wanted = draw(one_by_one, rays_one_by_one);
    const Image image = draw(*make_cpu_renderer(), rays);
    for (size_t i = 0; i < wanted.rgb.size(); ++i) {
      ASSERT_EQ(image.rgb[i], wanted.rgb[i]) << "seed " << seed << ", pixel " << i;
    }
    layers += scene->layers.size();
    for (const csgcore::Layer& layer : scene->layers) parts += layer.parts.size();
  }
  EXPECT_GT(layers, 200u);
  EXPECT_GT(parts, 200u);
  EXPECT_LT(rays, rays_one_by_one);
}

INSTANTIATE_TEST_SUITE_P(Layers, OnePass, testing::Values(Technique::kTiles, Technique::kCells),
                         [](const auto& technique) {
                           return technique.param == Technique::kTiles ? "Tiles" : "Cells";
                         });

}  // namespace
}  // namespace frontend
