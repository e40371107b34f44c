// Tests the final render of a plane figure: its colour without light, and its outlines.
#include "picture/flat_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "frontend/render.hpp"

namespace frontend {
namespace {

using testing::ElementsAre;

class FlatFigure : public testing::TestWithParam<double> {};

TEST_P(FlatFigure, HasTheSchemesColourWhereverItIsSeenFrom) {
  ImportedDesign design = import_design(parse("square(20, center = true);", "a.csg"),
                                        ImportOptions{.picture = PictureKind::kRendered});
  CameraOptions options;
  options.width_px = options.height_px = 100;
  Camera camera;
  camera.rotation_deg = {GetParam(), 0, 25};
  camera.distance = 140;
  const csgcore::View view = make_view(camera, options);
  RenderSettings settings;
  settings.renderer = RendererKind::kCpu;
  color_flat_figure(design.scene, view, settings.scheme);
  RenderStats stats;
  csgcore::Image image = render(design.scene, view, settings, stats);
  EXPECT_THAT(image.rgb[50 * 100 + 50], ElementsAre(0x00, 0xbf, 0x99));

  draw_flat_outlines(image, view, camera, design, settings.scheme);
  EXPECT_THAT(image.rgb[50 * 100 + 50], ElementsAre(0x00, 0xbf, 0x99));
  const auto red =
      std::count(image.rgb.begin(), image.rgb.end(), std::array<uint8_t, 3>{0xff, 0x00, 0x00});
  // Four sides of some 30 pixels, each two pixels wide; from aslant two of them are shorter.
  EXPECT_GT(red, 100);
  EXPECT_LT(red, 400);
}

INSTANTIATE_TEST_SUITE_P(Tilts, FlatFigure, testing::Values(0.0, 30.0, 55.0, 130.0));

}  // namespace
}  // namespace frontend
