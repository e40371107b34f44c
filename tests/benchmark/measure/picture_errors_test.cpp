#include "picture_errors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace measure {
namespace {

using csgcore::Hits;

/// Six pixels: three of primitive 4, 10 in depth; one of primitive 7 at 20; two misses.
Hits six_pixels() {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Hits hits;
  hits.primitive = {4, 4, 4, 7, Hits::kMiss, Hits::kMiss};
  hits.s = {10, 10, 10, 20, kFar, kFar};
  return hits;
}

PictureErrors errors_of(const Hits& seen) {
  PictureErrors errors;
  compare_hits(seen, six_pixels(), 100, errors);
  return errors;
}

Picture grey(std::vector<uint8_t> levels, uint32_t width_px) {
  Picture picture{width_px, static_cast<uint32_t>(levels.size()) / width_px, {}};
  for (const uint8_t level : levels) picture.rgb.push_back({level, level, level});
  return picture;
}

TEST(CompareHits, TheSameHasNoError) {
  const PictureErrors errors = errors_of(six_pixels());
  EXPECT_EQ(errors.wrong, 0u);
  EXPECT_EQ(errors.silhouette, 0u);
  EXPECT_EQ(errors.depth_worst, 0.0);
  EXPECT_EQ(errors.depth_mean, 0.0);
}

TEST(CompareHits, ASilhouetteIsWrongAndHasNoDepth) {
  Hits seen = six_pixels();
  seen.primitive[0] = Hits::kMiss;  // a hole
  seen.s[0] = std::numeric_limits<double>::infinity();
  seen.primitive[5] = 7;  // too large
  seen.s[5] = 20;
  const PictureErrors errors = errors_of(seen);
  EXPECT_EQ(errors.wrong, 2u);
  EXPECT_EQ(errors.silhouette, 2u);
  EXPECT_EQ(errors.depth_worst, 0.0);
}

TEST(CompareHits, AnotherPrimitiveIsWrongButNoSilhouette) {
  Hits seen = six_pixels();
  seen.primitive[2] = 7;
  EXPECT_EQ(errors_of(seen).wrong, 1u);
  EXPECT_EQ(errors_of(seen).silhouette, 0u);
}

TEST(CompareHits, DepthsAreSharesOfTheSize) {
  Hits seen = six_pixels();
  seen.s[1] = 11;
  seen.s[3] = 17;
  EXPECT_DOUBLE_EQ(*errors_of(seen).depth_worst, 0.03);
  EXPECT_DOUBLE_EQ(*errors_of(seen).depth_mean, 0.01);
}

TEST(CompareHits, WithoutDepthsThereIsNone) {
  Hits seen = six_pixels();
  seen.s.clear();
  EXPECT_EQ(errors_of(seen).wrong, 0u);
  EXPECT_FALSE(errors_of(seen).depth_worst);
  EXPECT_TRUE(nlohmann::json(errors_of(seen)).at("depth_worst").is_null());
}

TEST(CompareColours, CountsPixelsBeyondTheTolerance) {
  const Picture exact = grey({100, 100, 100, 100}, 2);
  Picture drawn = grey({124, 76, 125, 75}, 2);
  drawn.rgb[0][1] = 100;
  EXPECT_EQ(differing_pixels(drawn, exact), 2u);
  drawn = exact;
  drawn.rgb[3][2] = 125;  // one channel suffices
  EXPECT_EQ(differing_pixels(drawn, exact), 1u);
  EXPECT_THROW(differing_pixels(exact, grey({100, 100, 100, 100}, 4)), std::runtime_error);
}

TEST(CompareColours, RmsIsAgainstTheAntialiasedPicture) {
  PictureErrors errors;
  compare_colours(grey({0, 0, 0, 20}, 2), grey({0, 0, 0, 90}, 2), grey({0, 0, 0, 30}, 2), errors);
  EXPECT_EQ(errors.colour_wrong, 1u);
  EXPECT_DOUBLE_EQ(*errors.colour_rms, 5);
}

TEST(Averaged, TakesTheMeanOfSquares) {
  const Picture small = averaged(grey({0, 10, 50, 50,  //
                                       20, 33, 50, 54},
                                      4),
                                 2);
  EXPECT_EQ(small.width_px, 2u);
  EXPECT_EQ(small.height_px, 1u);
  EXPECT_THAT(small.rgb, testing::ElementsAre(testing::Each(16), testing::Each(51)));
}

}  // namespace
}  // namespace measure
