// Tests scenes far from unit size, drawn as the command draws them.
#include "frontend/render.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "csgcore/polyhedron.hpp"
#include "frontend/error.hpp"
#include "frontend/render_settings.hpp"
#include "support/models.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using csgcore::Op;
using csgcore::Projection;

/// A ball of the given size, minus a smaller one on the side that faces the camera.
csgcore::Scene bitten_ball(double size) {
  csgcore::Affine aside;
  aside.translation = {0, 0, size};
  return test_support::scene_of(
      Op::kDifference, {csgcore::make_sphere(size), csgcore::make_sphere(0.5 * size, aside)});
}

/// A cube with vertices of the given size, minus a corner whose size is in the matrix.
csgcore::Scene bitten_cube(double size) {
  using csgcore::Vec3;
  return test_support::scene_of(
      Op::kDifference,
      {csgcore::make_polyhedron(csgcore::Polyhedron::box({Vec3(-size), Vec3(size)})),
       csgcore::make_polyhedron(csgcore::Polyhedron::box({Vec3(0.0), Vec3(2.0)}),
                                {csgcore::Mat3(size), Vec3(0.5 * size)})});
}

Image draw(const csgcore::Scene& scene, double size, Projection projection, RendererKind renderer) {
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
  return render(scene, view, settings, stats);
}

class OfAnySize : public testing::TestWithParam<std::tuple<Projection, RendererKind>> {
 protected:
  static Image draw(double size) {
    const auto [projection, renderer] = GetParam();
    return frontend::draw(bitten_ball(size), size, projection, renderer);
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

TEST(Render, PolyhedraOfAnySize) {
  const auto draw_cube = [](double size) {
    return draw(bitten_cube(size), size, Projection::kPerspective, RendererKind::kCpu);
  };
  const Image unit = draw_cube(1);
  ASSERT_NEAR(unit.z[16 * 32 + 16], 3, 1e-6);
  for (const int exponent : {-250, -60, 60, 250}) {
    EXPECT_EQ(draw_cube(std::ldexp(1, exponent)).rgb, unit.rgb) << exponent;
  }
  EXPECT_THROW(draw_cube(std::ldexp(1, 305)), Error);
}

/// Beside so large a part it is not seen, and does no harm.
TEST(Render, WhatIsTooSmallForTheScaleShowsNothing) {
  const double size = std::ldexp(1, 250);
  for (const auto& tiny :
       {csgcore::make_sphere(std::ldexp(1, -250)),
        csgcore::make_sphere(std::ldexp(1, 290), {csgcore::Mat3(std::ldexp(1, -300)), {}})}) {
    csgcore::Affine aside;
    aside.translation = {0, 0, size};
    const csgcore::Scene scene = test_support::scene_of(
        Op::kDifference,
        {csgcore::make_sphere(size), csgcore::make_sphere(0.5 * size, aside), tiny});
    for (const RendererKind renderer : {RendererKind::kCpu, RendererKind::kGl}) {
      const Image image = draw(scene, size, Projection::kPerspective, renderer);
      EXPECT_EQ(image.rgb, draw(bitten_ball(size), size, Projection::kPerspective, renderer).rgb);
    }
  }
}

TEST(Render, RefusesWhatNoScaleMakesDrawable) {
  for (const double size : {1e100, 1e-100}) {
    try {
      draw(bitten_ball(size), size, Projection::kPerspective, RendererKind::kAuto);
      FAIL() << size;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("too large or too small")) << size;
    }
  }
}

}  // namespace
}  // namespace frontend
