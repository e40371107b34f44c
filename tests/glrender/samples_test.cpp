// Tests antialiasing: the pattern of the samples, and that a picture is the average of what they
// see.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "csgcore/view.hpp"
#include "fixture.hpp"
#include "support/models.hpp"

namespace {

using csgcore::Image;
using csgcore::Projection;
using csgcore::sample_offset;
using csgcore::Scene;
using csgcore::View;
using gl_test::leaves_of;
using gl_test::LoadedScene;
using glrender::Technique;

TEST(SamplePatternTest, OneSampleIsTheCentre) {
  EXPECT_EQ(sample_offset(0, 1), (std::array<double, 2>{0, 0}));
}

TEST(SamplePatternTest, LiesWithinThePixelAndIsItsOwnHalfTurn) {
  for (uint32_t n = 1; n <= 300; ++n) {
    for (uint32_t i = 0; i < n; ++i) {
      const auto [x, y] = sample_offset(i, n);
      ASSERT_LT(std::abs(x), 0.5) << i << " of " << n;
      ASSERT_LT(std::abs(y), 0.5) << i << " of " << n;
      ASSERT_EQ(sample_offset(n - 1 - i, n), (std::array<double, 2>{-x, -y})) << i << " of " << n;
    }
  }
}

TEST(SamplePatternTest, IsSpreadEvenlyAlongEachSide) {
  for (uint32_t n = 1; n <= 300; ++n) {
    std::vector<double> x, y;
    for (uint32_t i = 0; i < n; ++i) {
      x.push_back(sample_offset(i, n)[0]);
      y.push_back(sample_offset(i, n)[1]);
    }
    for (auto* side : {&x, &y}) {
      std::sort(side->begin(), side->end());
      side->push_back(side->front() + 1);  // the first sample of the next pixel
      double widest = 0;
      for (uint32_t i = 0; i < n; ++i) widest = std::max(widest, (*side)[i + 1] - (*side)[i]);
      // Among multiples of the golden ratio the widest gap never reaches twice the average.
      EXPECT_LT(widest * n, side == &x ? 1 + 1e-12 : 2.0) << n;
    }
  }
}

/// Fails unless `image` is, up to rounding, the average of the pictures that the samples see one by
/// one: an orthographic view displaced by a share of a pixel is one from another eye.
template <typename Draw>
void expect_average(const Image& image, const View& view, uint32_t samples, Draw&& draw) {
  std::vector<glm::vec3> sum(image.rgb.size(), glm::vec3(0));
  const double pixel = 2 * view.half_height / view.height_px;
  for (uint32_t i = 0; i < samples; ++i) {
    const auto [x, y] = sample_offset(i, samples);
    View displaced = view;
    displaced.eye += pixel * (x * view.right - y * view.up);
    const Image one = draw(displaced);
    for (size_t p = 0; p < sum.size(); ++p) {
      sum[p] += glm::vec3(one.rgb[p][0], one.rgb[p][1], one.rgb[p][2]);
    }
  }
  uint64_t wrong = 0;
  for (size_t p = 0; p < sum.size(); ++p) {
    for (int c = 0; c < 3; ++c) {
      // Each sample's own rounding is half a level, and that of the average another half.
      wrong += std::abs(sum[p][c] / static_cast<float>(samples) - image.rgb[p][c]) > 1.001f;
    }
  }
  // A ray that just meets an edge may miss it from an eye that is rounded differently.
  EXPECT_LE(wrong, 3u);
}

class SamplesTest : public testing::TestWithParam<std::tuple<uint32_t, Technique>> {
 protected:
  SamplesTest()
      : scene_(test_support::cylinder_minus_spheres(60)),
        view_(gl_test::view_from(scene_, Projection::kOrthographic, 25, 35)),
        loaded_(scene_, way()),
        centre_(loaded_.draw(view_)) {}

  static uint32_t samples() { return std::get<0>(GetParam()); }
  static gl_test::Way way() {
    return std::get<1>(GetParam()) == Technique::kTiles ? gl_test::by_tiles() : leaves_of(8);
  }

  Scene scene_;
  View view_;
  LoadedScene loaded_;
  Image centre_;
};

INSTANTIATE_TEST_SUITE_P(, SamplesTest,
                         testing::Combine(testing::Values(2u, 5u, 16u),
                                          testing::Values(Technique::kCells, Technique::kTiles)));

TEST_P(SamplesTest, AreAveraged) {
  loaded_.settings.samples = samples();
  loaded_.settings.measured_channels = false;
  const Image image = loaded_.draw(view_);
  EXPECT_NE(image.rgb, centre_.rgb);
  EXPECT_TRUE(image.z.empty());
  loaded_.settings.samples = 1;
  expect_average(image, view_, samples(), [&](const View& view) { return loaded_.draw(view); });
}

TEST_P(SamplesTest, LeaveTheMeasuredChannelsToTheCentre) {
  loaded_.settings.samples = samples();
  const Image image = loaded_.draw(view_);
  EXPECT_NE(image.rgb, centre_.rgb);
  EXPECT_EQ(image.z, centre_.z);
  EXPECT_EQ(image.normal, centre_.normal);
  EXPECT_EQ(image.position, centre_.position);
  EXPECT_EQ(image.id, centre_.id);
  EXPECT_EQ(loaded_.draw(view_).rgb, image.rgb) << "not the same twice";
}

TEST_P(SamplesTest, EachLieBehindAFrontOfTheirOwn) {
  const Image centre = loaded_.renderer.draw_behind(view_, loaded_.settings, loaded_.stats);
  loaded_.settings.samples = samples();
  loaded_.draw(view_);
  const Image image = loaded_.renderer.draw_behind(view_, loaded_.settings, loaded_.stats);
  EXPECT_NE(image.rgb, centre.rgb);
  EXPECT_EQ(image.z, centre.z);
  EXPECT_EQ(image.id, centre.id);
  loaded_.settings.samples = 1;
  expect_average(image, view_, samples(), [&](const View& view) {
    loaded_.draw(view);
    return loaded_.renderer.draw_behind(view, loaded_.settings, loaded_.stats);
  });
}

TEST_P(SamplesTest, CoverAPixelAsAFaceDoesInPerspective) {
  // A disc that faces the eye has one colour, so that a pixel's colour tells how many samples see
  // it.
  constexpr double kRadius = 5;
  Scene scene;
  scene.primitives.push_back(csgcore::make_frustum(-1, 0, kRadius, kRadius));
  csgcore::CsgTreeBuilder tree;
  tree.primitive(0);
  scene.model = tree.finish();
  View view;
  view.eye = {0.3, 0.2, 20};
  view.half_height = 0.3;
  view.width_px = view.height_px = 101;
  LoadedScene loaded(scene, way());
  loaded.settings.samples = samples();
  const Image image = loaded.draw(view);
  const double lit = image.rgb[size_t{50} * 101 + 50][0];
  ASSERT_GT(lit, 100);
  uint64_t partly = 0;
  for (uint32_t y = 0; y < view.height_px; ++y) {
    for (uint32_t x = 0; x < view.width_px; ++x) {
      uint32_t seen = 0;
      bool at_rim = false;  // so near to the rim that float cannot tell the side
      for (uint32_t i = 0; i < samples(); ++i) {
        const auto offset = sample_offset(i, samples());
        const csgcore::Ray ray = csgcore::pixel_ray(view, x + offset[0], y + offset[1]);
        const csgcore::Vec3 point = ray.origin + view.eye.z * ray.direction;
        seen += std::hypot(point.x, point.y) < kRadius;
        at_rim |= std::abs(std::hypot(point.x, point.y) - kRadius) < 1e-5;
      }
      partly += seen > 0 && seen < samples();
      if (at_rim) continue;
      EXPECT_NEAR(image.rgb[size_t{y} * 101 + x][0], lit * seen / samples(), 1) << x << ", " << y;
    }
  }
  EXPECT_GT(partly, 100u);
}

}  // namespace
