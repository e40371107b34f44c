// Tests what rounding to a file's numbers makes of surfaces.
#include "export/written_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "frontend/error.hpp"

namespace frontend {
namespace {

using csgcore::TriangleSet;
using csgcore::Vec3;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// A ball of rings of vertices.
TriangleSet ball(uint32_t rings, uint32_t around, const Vec3& center, double radius) {
  TriangleSet result;
  for (uint32_t i = 0; i <= rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    const uint32_t count = i == 0 || i == rings ? 1 : around;
    for (uint32_t j = 0; j < count; ++j) {
      const double angle = 2 * std::numbers::pi * j / around;
      result.vertices.push_back(center + radius * Vec3(std::sin(polar) * std::cos(angle),
                                                       std::sin(polar) * std::sin(angle),
                                                       std::cos(polar)));
    }
  }
  const auto at = [&](uint32_t i, uint32_t j) {
    if (i == 0) return 0u;
    return i == rings ? static_cast<uint32_t>(result.vertices.size()) - 1
                      : 1 + (i - 1) * around + j % around;
  };
  for (uint32_t i = 0; i < rings; ++i) {
    for (uint32_t j = 0; j < around; ++j) {
      if (i > 0) result.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + 1 < rings) result.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  }
  return result;
}

/// Returns by how many more triangles run through an edge in one direction than in the other, over
/// all edges.
uint32_t imbalance(const TriangleSet& surface) {
  std::map<std::pair<uint32_t, uint32_t>, int> count;
  for (const auto& t : surface.triangles) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = t[i], b = t[(i + 1) % 3];
      count[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  uint32_t result = 0;
  for (const auto& [edge, balance] : count) result += static_cast<uint32_t>(std::abs(balance));
  return result;
}

TEST(WrittenMesh, WhatIsWrittenExactlyStays) {
  TriangleSet surface = ball(6, 8, {0, 0, 0}, 1);
  const TriangleSet doubles = written_mesh(surface, Precision::kDouble, "a");
  EXPECT_EQ(doubles.vertices, surface.vertices);
  EXPECT_EQ(doubles.triangles, surface.triangles);
  const TriangleSet floats = written_mesh(surface, Precision::kFloat, "a");
  EXPECT_EQ(floats.triangles, surface.triangles);
  for (size_t i = 0; i < surface.vertices.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(floats.vertices[i][axis], static_cast<float>(surface.vertices[i][axis]));
    }
  }
}

/// Balls so far from the origin that neighbours of their vertices become one.
TEST(WrittenMesh, WhatCollapsesLeavesAClosedSurface) {
  for (const double distance : {1e6, 3e6, 1e7, 3e7}) {
    SCOPED_TRACE(distance);
    const TriangleSet surface = ball(40, 60, {distance, -distance / 3, distance / 7}, 5);
    EXPECT_EQ(imbalance(surface), 0u);
    const TriangleSet written = written_mesh(surface, Precision::kFloat, "a");
    EXPECT_LT(written.triangles.size(), surface.triangles.size());
    EXPECT_EQ(imbalance(written), 0u);
    std::set<uint32_t> used;
    std::set<std::array<uint32_t, 3>> triangles;
    for (const auto& t : written.triangles) {
      for (size_t i = 0; i < 3; ++i) {
        used.insert(t[i]);
        ASSERT_LT(t[i], written.vertices.size());
        EXPECT_NE(written.vertices[t[i]], written.vertices[t[(i + 1) % 3]]);
      }
      std::array<uint32_t, 3> back = {t[0], t[2], t[1]};
      std::rotate(back.begin(), std::min_element(back.begin(), back.end()), back.end());
      EXPECT_FALSE(triangles.contains(back)) << "the back of another one";
      std::array<uint32_t, 3> front = t;
      std::rotate(front.begin(), std::min_element(front.begin(), front.end()), front.end());
      triangles.insert(front);
    }
    EXPECT_THAT(used, SizeIs(written.vertices.size()));
  }
}

TEST(WrittenMesh, VerticesThatNoEdgeJoinsStayApart) {
  // Two balls that touch in a point, which each has for itself.
  TriangleSet surface = ball(4, 6, {0, 0, 0}, 1);
  const TriangleSet other = ball(4, 6, {0, 0, 2}, 1);
  const auto count = static_cast<uint32_t>(surface.vertices.size());
  surface.vertices.insert(surface.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) {
    surface.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  }
  EXPECT_THAT(written_mesh(surface, Precision::kFloat, "a").vertices, SizeIs(2 * count));
}

TEST(WrittenMesh, NothingIsLeftOfWhatIsTooSmall) {
  const TriangleSet surface = ball(4, 6, {1, 1, 1}, 1e-12);
  EXPECT_THAT(written_mesh(surface, Precision::kFloat, "a").triangles, IsEmpty());
  EXPECT_THAT(written_mesh(surface, Precision::kFloat, "a").vertices, IsEmpty());
  EXPECT_THAT(written_mesh(surface, Precision::kDouble, "a").triangles, SizeIs(36));
}

TEST(WrittenMesh, FloatsDoNotHoldWhatIsTooLarge) {
  const TriangleSet surface = ball(4, 6, {0, 0, 0}, 1e39);
  EXPECT_THAT(written_mesh(surface, Precision::kDouble, "a").triangles, SizeIs(36));
  try {
    written_mesh(surface, Precision::kFloat, "a.scad");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.scad: error: the solid is too large"));
  }
}

}  // namespace
}  // namespace frontend
