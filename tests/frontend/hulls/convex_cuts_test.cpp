// Set operations on convex polyhedra.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "hulls/point_solid.hpp"

namespace frontend {
namespace {

using csgcore::HalfSpace;
using csgcore::Vec3;

Corners box(const Vec3& min, const Vec3& max) {
  Corners corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z);
  }
  return corners;
}

bool contains(const std::vector<HalfSpace>& faces, const Vec3& point) {
  return std::all_of(faces.begin(), faces.end(), [&](const HalfSpace& face) {
    return glm::dot(face.normal, point) <= face.offset + 1e-12;
  });
}

TEST(ConvexCuts, LeaveWhatTheOperationsLeave) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 engine(seed);
    const auto number = [&](double from, double to) {
      return std::uniform_real_distribution<double>(from, to)(engine);
    };
    const auto random_points = [&] {
      Corners points;
      for (int i = 0; i < 10; ++i) {
        points.emplace_back(number(-1, 1), number(-1, 1), number(-1, 1));
      }
      return points;
    };
    const Corners a = random_points(), b = random_points();
    const auto faces_a = faces_of(a), faces_b = faces_of(b);
    std::vector<std::vector<HalfSpace>> rest;
    for (const Corners& piece : difference(a, faces_b)) rest.push_back(faces_of(piece));
    const auto common = faces_of(intersection(a, faces_b));
    for (int i = 0; i < 500; ++i) {
      const Vec3 point(number(-1, 1), number(-1, 1), number(-1, 1));
      const bool in_a = contains(faces_a, point), in_b = contains(faces_b, point);
      EXPECT_EQ(contains(common, point), in_a && in_b);
      EXPECT_EQ(std::any_of(rest.begin(), rest.end(),
                            [&](const auto& faces) { return contains(faces, point); }),
                in_a && !in_b);
    }
  }
}

TEST(ConvexCuts, MakeNoPiecesOfWhatOnlyTouches) {
  const Corners cube = box(Vec3(0), Vec3(1));
  EXPECT_EQ(difference(cube, faces_of(box(Vec3(1, 0, 0), Vec3(2, 1, 1)))).size(), 1u);
  EXPECT_TRUE(intersection(cube, faces_of(box(Vec3(1, 0, 0), Vec3(2, 1, 1)))).empty());
  EXPECT_TRUE(difference(cube, faces_of(box(Vec3(0), Vec3(1)))).empty());
  EXPECT_EQ(difference(cube, faces_of(box(Vec3(-1, -1, 0.25), Vec3(2, 2, 0.5)))).size(), 2u);
}

}  // namespace
}  // namespace frontend
