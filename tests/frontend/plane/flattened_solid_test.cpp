// Tests sections and shadows of solids that are made of triangles.
#include "plane/flattened_solid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "figure_area.hpp"
#include "plane/closed_walks.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

/// A box, whose triangles run counterclockwise as seen from outside.
TriangleSet box(const Vec3& min, const Vec3& max) {
  TriangleSet result;
  for (const double z : {min.z, max.z}) {
    result.vertices.insert(
        result.vertices.end(),
        {{min.x, min.y, z}, {max.x, min.y, z}, {max.x, max.y, z}, {min.x, max.y, z}});
  }
  result.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t j = (i + 1) % 4;
    result.triangles.push_back({i, j, j + 4});
    result.triangles.push_back({i, j + 4, i + 4});
  }
  return result;
}

TriangleSet joined(TriangleSet a, const TriangleSet& b) {
  const auto first = static_cast<uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& triangle : b.triangles) {
    a.triangles.push_back({triangle[0] + first, triangle[1] + first, triangle[2] + first});
  }
  return a;
}

/// A ball whose surface is uneven.
TriangleSet rough_ball(uint32_t rings, double unevenness) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> radius(1 - unevenness, 1 + unevenness);
  TriangleSet result;
  result.vertices.emplace_back(0, 0, -1);
  for (uint32_t ring = 1; ring < rings; ++ring) {
    for (uint32_t i = 0; i < rings; ++i) {
      const double polar = kPi * ring / rings, azimuth = 2 * kPi * i / rings;
      result.vertices.push_back(radius(random) * Vec3(std::sin(polar) * std::cos(azimuth),
                                                      std::sin(polar) * std::sin(azimuth),
                                                      -std::cos(polar)));
    }
  }
  result.vertices.emplace_back(0, 0, 1);
  const auto last = static_cast<uint32_t>(result.vertices.size()) - 1;
  for (uint32_t i = 0; i < rings; ++i) {
    const uint32_t j = (i + 1) % rings;
    result.triangles.push_back({0, 1 + j, 1 + i});
    for (uint32_t ring = 0; ring + 2 < rings; ++ring) {
      const uint32_t below = 1 + ring * rings, above = below + rings;
      result.triangles.push_back({below + i, below + j, above + j});
      result.triangles.push_back({below + i, above + j, above + i});
    }
    result.triangles.push_back({last, last - rings + i, last - rings + j});
  }
  return result;
}

TEST(ClosedWalks, TakeEachArcOnce) {
  const auto walks = closed_walks({{1, 2}, {2, 1}, {2, 3}, {3, 2}, {7, 7}});
  size_t arcs = 0;
  for (const auto& walk : walks) arcs += walk.size();
  EXPECT_EQ(arcs, 5u);
  EXPECT_TRUE(closed_walks({}).empty());
}

TEST(SectionOfTriangles, IsThatOfTheSolid) {
  EXPECT_DOUBLE_EQ(area_of_union(section_of(box({0, 0, -1}, {3, 2, 2}))), 6);
  EXPECT_TRUE(section_of(box({0, 0, 1}, {3, 2, 2})).empty());
  // A cavity, whose triangles run the other way.
  TriangleSet cavity = box({1, 1, -0.5}, {2, 2, 0.5});
  for (auto& triangle : cavity.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_DOUBLE_EQ(area_of_union(section_of(joined(box({0, 0, -1}, {3, 3, 2}), cavity))), 8);
}

TEST(SectionOfTriangles, HasTheFacesThatLieInThePlane) {
  EXPECT_DOUBLE_EQ(area_of_union(section_of(box({0, 0, 0}, {3, 2, 2}))), 6);
  EXPECT_DOUBLE_EQ(area_of_union(section_of(box({0, 0, -2}, {3, 2, 0}))), 6);
  EXPECT_DOUBLE_EQ(
      area_of_union(section_of(joined(box({0, 0, -2}, {3, 2, 0}), box({2, 0, 0}, {5, 2, 1})))), 10);
}

TEST(SectionOfTriangles, HasNothingOfACornerOrAnEdge) {
  const TriangleSet above{{{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {-1, -1, 1}},
                          {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
  EXPECT_TRUE(section_of(above).empty());
  // The same corner in the midst of the section.
  TriangleSet through = above;
  for (Vec3& vertex : through.vertices) vertex.z = vertex.x + vertex.y / 2;
  through.vertices[0].z = 0;
  EXPECT_LE(section_of(through).size(), 1u);
}

TEST(ShadowOfTriangles, CoversWhatAnyOfThemCovers) {
  const auto shadow =
      shadow_of(joined(box({0, 0, 0}, {2, 2, 2}), box({1, 1, 5}, {3, 3, 6})), Boundary::kClosed);
  ASSERT_TRUE(shadow);
  EXPECT_DOUBLE_EQ(area_of(*shadow), 7);
}

TEST(ShadowOfTriangles, IsTheSameWhicheverWayTheyRun) {
  TriangleSet inverted = box({0, 0, 0}, {2, 3, 2});
  for (auto& triangle : inverted.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_DOUBLE_EQ(area_of(shadow_of(inverted, Boundary::kClosed).value()), 6);
  const TriangleSet open{{{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 5}}, {{0, 2, 1}, {1, 3, 2}}};
  EXPECT_DOUBLE_EQ(area_of(shadow_of(open, Boundary::kOpen).value()), 1);
}

TEST(ShadowOfTriangles, HasNoSlitsAlongEdgesWithCornersOfOthers) {
  for (double turn = 0.1; turn < 6; turn += 0.37) {
    const auto at = [&](double x, double y) {
      return Vec3(std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y,
                  0);
    };
    // Triangles on both sides of an edge; only those on the right have corners within it.
    TriangleSet sheet{{at(0, 0), at(30, 10), at(0, 20), at(20, -10)}, {{0, 1, 2}}};
    constexpr uint32_t kParts = 7;
    for (uint32_t i = 0; i <= kParts; ++i) {
      sheet.vertices.push_back(at(30.0 * i / kParts, 10.0 * i / kParts));
    }
    for (uint32_t i = 4; i < 4 + kParts; ++i) sheet.triangles.push_back({i + 1, i, 3});
    const std::optional<Figure> shadow = shadow_of(sheet, Boundary::kOpen);
    ASSERT_TRUE(shadow);
    const Outline& outline = std::get<Outline>(*shadow);
    ASSERT_EQ(outline.loops.size(), 1u) << turn;
    EXPECT_EQ(outline.loops.front().size(), 4u) << turn;
  }
}

TEST(ShadowOfTriangles, OfARoughSolidHasNoCracks) {
  const std::optional<Figure> shadow = shadow_of(rough_ball(180, 0.3), Boundary::kClosed);
  ASSERT_TRUE(shadow);
  EXPECT_EQ(std::get<Outline>(*shadow).loops.size(), 1u);
  EXPECT_GT(area_of(*shadow), kPi);
  EXPECT_LT(area_of(*shadow), 2.25 * kPi);
}

}  // namespace
}  // namespace frontend
