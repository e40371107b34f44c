// Tests the roof over an outline.
#include "plane/roof.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "plane/roof_support.hpp"

namespace frontend {
namespace {

using ::testing::SizeIs;

constexpr double kNoBevels = 0;
constexpr double kAngles[] = {0, 0.3, 1.234, 2.5};

const SimplePolygons kSquare{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
const SimplePolygons kRectangle{{{0, 0}, {20, 0}, {20, 10}, {0, 10}}};
const SimplePolygons kCross{{{10, 0},
                             {20, 0},
                             {20, 10},
                             {30, 10},
                             {30, 20},
                             {20, 20},
                             {20, 30},
                             {10, 30},
                             {10, 20},
                             {0, 20},
                             {0, 10},
                             {10, 10}}};
const SimplePolygons kFrame{{{0, 0}, {30, 0}, {30, 30}, {0, 30}},
                            {{10, 10}, {10, 20}, {20, 20}, {20, 10}}};

/// Expects that the roof is a solid whose faces all rise at the same slope, and returns it.
Roof sound_roof(const SimplePolygons& outline, double bevel_step) {
  const std::optional<Roof> roof = roof_over(outline, bevel_step);
  EXPECT_TRUE(roof.has_value());
  if (!roof) return {};
  EXPECT_TRUE(is_closed(*roof));
  double size = 0;
  for (const csgcore::Vec3& point : roof->points) size = std::max(size, glm::length(point));
  visit_faces(*roof, [&](std::span<const uint32_t> face) {
    const csgcore::Vec3 area = area_of_face(*roof, face);
    EXPECT_NEAR(area.z, std::hypot(area.x, area.y), 1e-9 * size * size);
  });
  return *roof;
}

double volume_over(const SimplePolygons& outline, double bevel_step = kNoBevels) {
  return volume_of(sound_roof(outline, bevel_step));
}

double top_of(const Roof& roof) {
  double top = 0;
  for (const csgcore::Vec3& point : roof.points) top = std::max(top, point.z);
  return top;
}

TEST(Roof, IsAPyramidOverASquareAndHasARidgeOverARectangle) {
  for (const double angle : kAngles) {
    const Roof pyramid = sound_roof(turned(kSquare, angle), kNoBevels);
    EXPECT_THAT(pyramid.points, SizeIs(5));
    EXPECT_NEAR(top_of(pyramid), 5, 1e-12);
    const Roof hip = sound_roof(turned(kRectangle, angle), kNoBevels);
    EXPECT_THAT(hip.points, SizeIs(6));
    EXPECT_THAT(hip.ends, SizeIs(4));
    EXPECT_NEAR(volume_of(hip), 1250.0 / 3, 1e-9);
  }
  EXPECT_THAT(sound_roof({}, kNoBevels).points, SizeIs(0));
}

TEST(Roof, TakesCornersThatMeetAtOnePlaceAndTime) {
  SimplePolygons grid{{{0, 0}, {50, 0}, {50, 50}, {0, 50}}};
  for (const double x : {10.0, 30.0}) {
    for (const double y : {10.0, 30.0}) {
      grid.push_back({{x, y}, {x, y + 10}, {x + 10, y + 10}, {x + 10, y}});
    }
  }
  SimplePolygons comb{{{0, 0}, {200, 0}, {200, 10}}};
  for (int i = 19; i >= 0; --i) {
    const double x = 10 * i;
    for (const Vec2& point : {Vec2(x + 5, 10), Vec2(x + 5, 30), Vec2(x, 30)}) {
      comb[0].push_back(point);
    }
    if (i > 0) comb[0].emplace_back(x, 10);
  }
  for (const double angle : kAngles) {
    EXPECT_NEAR(volume_over(turned(kCross, angle)), 3500.0 / 3, 1e-8);
    EXPECT_NEAR(volume_over(turned(kFrame, angle)), 2000, 1e-8);
    EXPECT_NEAR(volume_over(turned(grid, angle)), 5500, 1e-8);
    EXPECT_NEAR(volume_over(turned(comb, angle)), 22250.0 / 3, 1e-8);
  }
}

TEST(Roof, EndsInAPointOverARegularPolygonAndStar) {
  for (const int corners : {3, 5, 7, 100, 999, 10'000}) {
    const Roof cone = sound_roof(
        {star({3, 4}, std::vector<double>(static_cast<size_t>(corners), 10))}, kNoBevels);
    const double apothem = 10 * std::cos(std::numbers::pi / corners);
    EXPECT_NEAR(top_of(cone), apothem, 1e-8) << corners;
    const double area = corners * apothem * 10 * std::sin(std::numbers::pi / corners);
    EXPECT_NEAR(volume_of(cone), area * apothem / 3, 1e-6) << corners;
  }
  for (const size_t tips : {4, 5, 6, 12}) {
    std::vector<double> radii;
    for (size_t i = 0; i < tips; ++i) radii.insert(radii.end(), {10, 6});
    const Roof roof = sound_roof({star(Vec2(0.0), radii)}, kNoBevels);
    EXPECT_THAT(roof.points, SizeIs(2 * tips + 1)) << tips;
  }
}

TEST(Roof, TakesOutlinesThatTouchInACorner) {
  // A hole whose corner lies on an edge, one whose corner is a corner of the outline, and two
  // squares, in one polygon that passes the corner twice.
  const SimplePolygons on_edge{{{0, 0}, {30, 0}, {30, 30}, {0, 30}}, {{0, 15}, {15, 20}, {15, 10}}};
  const SimplePolygons at_corner{{{0, 0}, {30, 0}, {30, 30}, {0, 30}}, {{0, 0}, {5, 10}, {10, 5}}};
  const SimplePolygons twice{
      {{0, 0}, {10, 0}, {10, 10}, {20, 10}, {20, 20}, {10, 20}, {10, 10}, {0, 10}}};
  for (const double angle : kAngles) {
    for (const SimplePolygons& outline : {on_edge, at_corner}) {
      const SimplePolygons own = turned(outline, angle);
      const Roof roof = sound_roof(own, 0.02);
      const SimplePolygons points =
          turned({{{3, 20}, {15, 25}, {20, 8}, {3, 12}, {7, 2}, {1, 5}}}, angle);
      for (const Vec2& point : points.front()) {
        const double distance = distance_to(own, point);
        EXPECT_NEAR(height_at(roof, point), distance, 1e-4 * distance);
      }
    }
    EXPECT_NEAR(volume_over(turned(twice, angle)), 1000.0 / 3, 1e-9);
  }
}

TEST(Roof, HasNoFacesForPointsThatAreNoCorners) {
  const SimplePolygons outline{
      {{0, 0}, {5, 0}, {5, 0}, {10, 0}, {10, 10}, {5, 10}, {0, 10}, {0, 3}}};
  EXPECT_THAT(sound_roof(outline, kNoBevels).points, SizeIs(5));
}

TEST(Roof, IsTheDistanceFromTheOutlineWithBevels) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  constexpr double kStep = std::numbers::pi / 60;
  const double most_share = 1 - std::cos(kStep / 2);
  int points = 0;
  for (int i = 0; i < 60; ++i) {
    const SimplePolygons outline = random_outline(random, 0);
    const Roof roof = sound_roof(outline, kStep);
    for (int k = 0; k < 40; ++k) {
      const Vec2 point{coordinate(random), coordinate(random)};
      if (!is_within(outline, point)) continue;
      ++points;
      const double distance = distance_to(outline, point);
      const double height = height_at(roof, point);
      EXPECT_LE(height, distance + 1e-9);
      EXPECT_GE(height, distance * (1 - most_share) - 1e-9);
    }
  }
  EXPECT_GT(points, 900);
}

TEST(Roof, IsFoundForManyCornersInASecond) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> radius(0.5, 1);
  std::vector<double> radii(10'000);
  for (double& r : radii) r = radius(random);
  const auto start = std::chrono::steady_clock::now();
  const std::optional<Roof> roof = roof_over({star(Vec2(0.0), radii)}, kNoBevels);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  ASSERT_TRUE(roof.has_value());
  EXPECT_THAT(roof->ends, SizeIs(10'000));
  EXPECT_TRUE(is_closed(*roof));
  EXPECT_LT(time.count(), 20);  // 0.6 s; more where sanitizers and other programs run
}

TEST(Roof, IsNoneOverPolygonsThatCross) {
  const SimplePolygons crossing{{{0, 0}, {10, 0}, {10, 10}, {0, 10}},
                                {{5, 5}, {15, 5}, {15, 15}, {5, 15}}};
  const std::optional<Roof> roof = roof_over(crossing, kNoBevels);
  EXPECT_TRUE(!roof || is_closed(*roof));
}

}  // namespace
}  // namespace frontend
