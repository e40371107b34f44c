// Scenes far from unit size, drawn as the command draws them.
#include "frontend/render.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "frontend/color_scheme.hpp"
#include "frontend/error.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using csgcore::Op;
using csgcore::Projection;

/// A ball of the given size, less a smaller one on its side that faces the camera.
csgcore::Scene bitten_ball(double size) {
  csgcore::Scene scene;
  scene.primitives.push_back(csgcore::make_sphere(size));
  csgcore::Affine aside;
  aside.translation = {0, 0, size};
  scene.primitives.push_back(csgcore::make_sphere(0.5 * size, aside));
  csgcore::CsgTreeBuilder builder;
  builder.open(Op::kDifference);
  builder.primitive(0);
  builder.primitive(1);
  builder.close();
  scene.model = builder.finish();
  return scene;
}

Image draw(double size, Projection projection, RendererKind renderer) {
  csgcore::View view;
  view.projection = projection;
  view.eye = {0, 0, 4 * size};
  view.half_height = projection == Projection::kPerspective ? 0.5 : 2 * size;
  view.width_px = view.height_px = 32;
  RenderSettings settings;
  settings.scheme = *find_color_scheme("Cornfield");
  settings.renderer = renderer;
  settings.measured_channels = true;
  RenderStats stats;
  return render(bitten_ball(size), view, settings, stats);
}

class OfAnySize : public testing::TestWithParam<std::tuple<Projection, RendererKind>> {
 protected:
  static Image draw(double size) {
    return frontend::draw(size, std::get<0>(GetParam()), std::get<1>(GetParam()));
  }
};

TEST_P(OfAnySize, ThePictureIsTheSame) {
  const Image unit = draw(1);
  const size_t middle = 16 * 32 + 16;
  ASSERT_NEAR(unit.z[middle], 3.5, 0.01);
  for (const int exponent : {-120, -60, -41, 41, 60, 120}) {
    const double size = std::ldexp(1, exponent);
    const Image image = draw(size);
    EXPECT_EQ(image.rgb, unit.rgb) << exponent;
    EXPECT_EQ(image.id, unit.id) << exponent;
    EXPECT_FLOAT_EQ(image.z[middle], static_cast<float>(unit.z[middle] * size)) << exponent;
    EXPECT_FLOAT_EQ(image.position[middle].z, static_cast<float>(unit.position[middle].z * size))
        << exponent;
  }
}

INSTANTIATE_TEST_SUITE_P(, OfAnySize,
                         testing::Combine(testing::Values(Projection::kPerspective,
                                                          Projection::kOrthographic),
                                          testing::Values(RendererKind::kGl, RendererKind::kCpu)));

TEST(Render, RefusesWhatNoScaleMakesDrawable) {
  for (const double size : {1e100, 1e-100}) {
    try {
      draw(size, Projection::kPerspective, RendererKind::kAuto);
      FAIL() << size;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("too large or too small")) << size;
    }
  }
}

}  // namespace
}  // namespace frontend
