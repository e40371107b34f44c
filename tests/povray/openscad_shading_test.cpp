// Tests the scenes that the benchmark gives POV-Ray: OpenSCAD's shading, and primitives told apart
// by colour.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "csgcore/facets.hpp"
#include "csgcore/polyhedron.hpp"
#include "povray.hpp"
#ifdef SCADRAY_HAS_RENDER
#include "frontend/render.hpp"
#include "support/read_design.hpp"
#endif

namespace povray {
namespace {

using csgcore::Box;
using csgcore::kNoPrimitive;
using csgcore::Scene;
using csgcore::Vec3;
using csgcore::View;

const csgcore::ReferenceColors kPaleColors{
    .background = {1, 1, 0.9}, .front = {0.5, 0.4, 0.2}, .back = {0.6, 0.8, 0.3}};

/// Looks along −z, from above.
View from_above(double half_height) {
  View view;
  view.eye = {0, 0, 50};
  view.half_height = half_height / view.eye.z;
  view.width_px = view.height_px = 101;
  return view;
}
constexpr size_t kMiddle = 50 * 101 + 50;

/// A box from −1 to 1, minus a ball in its top.
Scene dented_box() {
  Scene scene;
  scene.primitives = {csgcore::make_polyhedron(csgcore::Polyhedron::box({Vec3(-1), Vec3(1)})),
                      csgcore::make_sphere(0.5, {csgcore::Mat3(1.0), {0, 0, 1}})};
  csgcore::CsgTreeBuilder builder;
  builder.open(csgcore::Op::kDifference);
  builder.primitive(0);
  builder.primitive(1);
  builder.close();
  scene.model = builder.finish();
  return scene;
}

class PovRayScenes : public testing::Test {
 protected:
  void SetUp() override {
    if (!installed()) GTEST_SKIP() << "povray is not installed";
  }
};

TEST_F(PovRayScenes, AreShadedAsOpenScadDoes) {
  const Pixels pixels =
      render(openscad_scene_text(dented_box(), from_above(2), kPaleColors), 101, 101);
  // The normal is the view's axis in the middle of the dent and on top: 0.2 + 1/√3 of the colour.
  EXPECT_THAT(pixels[kMiddle], testing::ElementsAre(119, 159, 59));
  EXPECT_THAT(pixels[kMiddle + 20], testing::ElementsAre(99, 79, 40));
  EXPECT_THAT(pixels[0], testing::ElementsAre(255, 255, 230));
}

TEST_F(PovRayScenes, TellPrimitivesApart) {
  const Pixels pixels = render(id_scene_text(dented_box(), from_above(2)), 101, 101);
  EXPECT_EQ(primitive_of(pixels[kMiddle]), 1u);
  EXPECT_EQ(primitive_of(pixels[kMiddle + 20]), 0u);
  EXPECT_EQ(primitive_of(pixels[0]), kNoPrimitive);
}

TEST_F(PovRayScenes, HaveAColourForEachOfThousands) {
  EXPECT_EQ(primitive_of({0, 0, 1}), 0u);
  EXPECT_EQ(primitive_of({0, 1, 0}), 255u);
  EXPECT_EQ(primitive_of({1, 2, 3}), 0x010202u);
}

#ifdef SCADRAY_HAS_RENDER
/// Scenes with cubes, polyhedra, cylinders and colours.
TEST_F(PovRayScenes, AreThoseThatScadrayDraws) {
  const Scene scene = test_support::read_design(SCADRAY_EXAMPLES_DIR "/bracket.scad").scene;
  View view;
  view.eye = {-160, -180, 150};
  const Vec3 target(-25, -20, 15);
  view.forward = glm::normalize(target - view.eye);
  view.right = glm::normalize(glm::cross(view.forward, Vec3(0, 0, 1)));
  view.up = glm::cross(view.right, view.forward);
  view.half_height = 0.2;
  view.width_px = view.height_px = 240;
  frontend::RenderSettings settings;
  settings.renderer = frontend::RendererKind::kCpu;
  settings.measured_channels = true;
  frontend::RenderStats stats;
  const csgcore::Image image = frontend::render(scene, view, settings, stats);
  const auto color = [](const frontend::Rgb& rgb) { return Vec3(rgb.r, rgb.g, rgb.b) / 255.0; };
  const csgcore::ReferenceColors colors{color(settings.scheme.background),
                                        color(settings.scheme.front), color(settings.scheme.back)};
  const Pixels shaded = render(openscad_scene_text(scene, view, colors), 240, 240);
  const Pixels ids = render(id_scene_text(scene, view), 240, 240);
  size_t hits = 0, other_colour = 0, other_primitive = 0;
  for (size_t i = 0; i < ids.size(); ++i) {
    const uint32_t primitive = primitive_of(ids[i]);
    hits += primitive != kNoPrimitive;
    const uint32_t id =
        primitive == kNoPrimitive ? kNoPrimitive : scene.primitives.at(primitive).id;
    other_primitive += id != image.id[i];
    for (size_t c = 0; c < 3; ++c) {
      other_colour += std::abs(shaded[i][c] - image.rgb[i][c]) > 2;
    }
  }
  EXPECT_GT(hits, ids.size() / 10);
  // An edge may run through a pixel's centre; none was seen to.
  EXPECT_LE(other_colour, hits / 1000);
  // Where parts share a face, POV-Ray shows the first part.
  EXPECT_LE(other_primitive, hits / 100);
}
#endif

}  // namespace
}  // namespace povray
