// Compares the roof with CGAL's straight skeleton.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "oracle/straight_skeleton.hpp"
#include "plane/roof.hpp"
#include "plane/roof_support.hpp"

namespace frontend {
namespace {

/// Returns the distance from the edge whose face the point lies in.
double height_at(const std::vector<oracle::SkeletonFace>& faces, const Vec2& point) {
  for (const oracle::SkeletonFace& face : faces) {
    if (!is_within({face.corners}, point)) continue;
    const Vec2 along = face.end - face.start;
    return std::abs(cross(along, point - face.start)) / glm::length(along);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Returns whether the polygons are one that is simple, and holes that touch nothing.
bool is_outline(const SimplePolygons& polygons) {
  for (size_t i = 0; i < polygons.size(); ++i) {
    const bool is_hole = i > 0;
    if (!oracle::is_simple(polygons[i]) || (signed_area(polygons[i]) < 0) != is_hole) return false;
    for (size_t j = 0; j < i; ++j) {
      for (const Vec2& point : polygons[i]) {
        const bool is_around = j == 0;
        if (distance_to({polygons[j]}, point) < 1e-9) return false;
        if (is_within({polygons[j]}, point) != is_around) return false;
      }
    }
  }
  return true;
}

TEST(RoofOracle, HasTheHeightsOfCgalsStraightSkeleton) {
  constexpr int kOutlines = 500;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  int points = 0;
  for (int found = 0; found < kOutlines;) {
    // Half of them have coordinates on a grid, so that events fall together.
    const SimplePolygons outline = random_outline(random, found % 2 == 0 ? 0 : 1.0 / 32);
    if (!is_outline(outline)) continue;
    ++found;
    const std::vector<oracle::SkeletonFace> expected = oracle::straight_skeleton(outline);
    ASSERT_FALSE(expected.empty());
    const std::optional<Roof> roof = roof_over(outline, 0);
    ASSERT_TRUE(roof.has_value()) << found;
    ASSERT_TRUE(is_closed(*roof)) << found;
    for (int k = 0; k < 40; ++k) {
      const Vec2 point(coordinate(random), coordinate(random));
      if (!is_within(outline, point)) continue;
      ++points;
      ASSERT_NEAR(frontend::height_at(*roof, point), height_at(expected, point), 1e-9)
          << found << ": " << point.x << ' ' << point.y;
    }
  }
  EXPECT_GT(points, 8000);
}

}  // namespace
}  // namespace frontend
