// Tests convex hulls of discs and points against their support functions.
#include "plane/hull.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "plane/figure_area.hpp"

namespace frontend {
namespace {

using ::testing::SizeIs;

/// How far the discs reach in a direction.
double support(std::span<const Disc> discs, const Vec2& way) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Disc& disc : discs) most = std::max(most, glm::dot(disc.center, way) + disc.radius);
  return most;
}

void expect_hull(const std::vector<Disc>& discs, const std::string& what) {
  const Figure hull = convex_hull(discs);
  Polygon points;
  double largest = 0;
  for (const Polygon& polygon : chords_of(hull)) {
    points.insert(points.end(), polygon.begin(), polygon.end());
  }
  for (const Disc& disc : discs) largest = std::max(largest, disc.radius);
  const double tolerance = 1e-4 * largest + 1e-9;
  for (int i = 0; i < 100; ++i) {
    const double angle = 2 * kPi * i / 100;
    const Vec2 way(std::cos(angle), std::sin(angle));
    double reach = -std::numeric_limits<double>::infinity();
    for (const Vec2& point : points) reach = std::max(reach, glm::dot(point, way));
    EXPECT_NEAR(reach, support(discs, way), tolerance) << what << ", direction " << i;
  }
}

TEST(ConvexHull, OfTwoEqualDiscsIsASlotWithExactSides) {
  const Outline slot = std::get<Outline>(convex_hull(std::vector<Disc>{{{0, 0}, 2}, {{10, 0}, 2}}));
  ASSERT_THAT(slot.loops, SizeIs(1));
  ASSERT_THAT(slot.loops[0], SizeIs(4));
  EXPECT_EQ(bounds_of(slot).min, Vec2(-2, -2));
  EXPECT_EQ(bounds_of(slot).max, Vec2(12, 2));
  EXPECT_NEAR(area_of(slot), 40 + 4 * kPi, 4 * kPi * kChordsShare);
}

TEST(ConvexHull, OfPointsHasTheirCorners) {
  const Figure hull = convex_hull(
      std::vector<Disc>{{{0, 0}, 0}, {{1, 1}, 0}, {{2, 0}, 0}, {{2, 2}, 0}, {{0, 2}, 0}});
  EXPECT_THAT(convex_corners(hull).value(), SizeIs(4));
  EXPECT_EQ(area_of(hull), 4);
}

TEST(ConvexHull, OfFewerThanThreeCornersIsEmpty) {
  EXPECT_TRUE(bounds_of(convex_hull({})).empty());
  EXPECT_TRUE(bounds_of(convex_hull(std::vector<Disc>{{{0, 0}, 0}, {{1, 1}, 0}})).empty());
  EXPECT_TRUE(
      bounds_of(convex_hull(std::vector<Disc>{{{0, 0}, 0}, {{1, 1}, 0}, {{3, 3}, 0}})).empty());
}

TEST(ConvexHull, IsTheDiscThatHoldsAllOthers) {
  EXPECT_TRUE(std::holds_alternative<Disc>(
      convex_hull(std::vector<Disc>{{{0, 0}, 5}, {{1, 1}, 1}, {{2, 0}, 0}})));
}

TEST(ConvexHull, OfAPointAndADiscIsADrop) {
  expect_hull({{{0, 0}, 1}, {{5, 0}, 0}}, "drop");
  expect_hull({{{0, 0}, 1}, {{0, -5}, 0}}, "drop downwards");
}

TEST(ConvexHull, OfDiscsInARowTouchesAll) {
  expect_hull({{{0, 0}, 1}, {{5, 0}, 1}, {{10, 0}, 1}}, "row");
  expect_hull({{{0, 0}, 1}, {{0, 5}, 1}, {{0, 10}, 1}, {{0, 10}, 1}}, "row upwards, one twice");
  expect_hull({{{0, 0}, 3}, {{4, 0}, 2}, {{8, 0}, 1}}, "row with common tangents");
}

TEST(ConvexHull, OfRandomDiscs) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-10, 10), radius(0, 4);
  for (int run = 0; run < 300; ++run) {
    std::vector<Disc> discs;
    const int count = 2 + run % 9;
    for (int i = 0; i < count; ++i) {
      // Whole numbers have many common tangents.
      const bool is_whole = run % 2 == 0;
      Disc disc{{place(random), place(random)}, i % 3 == 0 ? 0 : radius(random)};
      if (is_whole) disc = {glm::floor(disc.center), std::floor(disc.radius)};
      discs.push_back(disc);
    }
    if (std::all_of(discs.begin(), discs.end(), [](const Disc& d) { return d.radius == 0; })) {
      discs[0].radius = 1;
    }
    expect_hull(discs, "run " + std::to_string(run));
  }
}

}  // namespace
}  // namespace frontend
