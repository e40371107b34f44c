// The exact hull of points: its boundary is closed and convex, and holds all points, however
// degenerate they are.
#include "hulls/point_hull.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "csgcore/polyhedron.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "hulls/point_solid.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

std::vector<Vec3> cube_points(double size) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.push_back(size * Vec3(i & 1, (i >> 1) & 1, i >> 2));
  return points;
}

/// Of a solid: every edge is passed once in each direction, neighbours are each other's, and no
/// point lies outside of a face.
void expect_hull(const std::vector<Vec3>& points) {
  const PointGrid grid = on_grid(points);
  const PointHull hull = point_hull(grid);
  ASSERT_EQ(hull.dimension, 3);
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> face_of_edge;
  std::set<uint32_t> corners;
  for (uint32_t t = 0; t < hull.triangles.size(); ++t) {
    const PointHull::Triangle& triangle = hull.triangles[t];
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_TRUE(face_of_edge.try_emplace({triangle[k], triangle[(k + 1) % 3]}, t).second);
      corners.insert(triangle[k]);
    }
    for (const GridPoint& point : grid.points) {
      ASSERT_LE(orientation(grid.points[triangle[0]], grid.points[triangle[1]],
                            grid.points[triangle[2]], point),
                0);
    }
  }
  for (uint32_t t = 0; t < hull.triangles.size(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      const auto other = face_of_edge.find({hull.triangles[t][(k + 1) % 3], hull.triangles[t][k]});
      ASSERT_NE(other, face_of_edge.end());
      EXPECT_EQ(other->second, hull.neighbors[t][k]);
    }
  }
  EXPECT_EQ(std::vector<uint32_t>(corners.begin(), corners.end()), hull.corners);
  EXPECT_EQ(hull.triangles.size(), 2 * corners.size() - 4) << "by Euler";
}

TEST(PointHull, OfRandomAndOfGridPointsIsClosedAndConvex) {
  for (uint32_t seed = 0; seed < 40; ++seed) {
    std::mt19937 engine(seed);
    std::vector<Vec3> points;
    const bool is_grid = seed % 2 == 0;
    for (int i = 0; i < 100; ++i) {
      Vec3 point;
      for (int axis = 0; axis < 3; ++axis) {
        point[axis] = is_grid ? std::uniform_int_distribution<int>(0, 3)(engine)
                              : std::uniform_real_distribution<double>(-1, 1)(engine);
      }
      points.push_back(point);
    }
    expect_hull(points);
  }
}

TEST(PointHull, OfNearlyFlatPointsIsExact) {
  // Heights of some units of the grid: the sign of a double's determinant would be a guess.
  for (uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 engine(seed);
    std::vector<Vec3> points;
    for (int i = 0; i < 60; ++i) {
      const double x = std::uniform_real_distribution<double>(0, 1)(engine);
      const double y = std::uniform_real_distribution<double>(0, 1)(engine);
      points.emplace_back(x, y,
                          x + y + 0x1p-50 * std::uniform_int_distribution<int>(-4, 4)(engine));
    }
    expect_hull(points);
  }
}

TEST(PointHull, TellsTheDimension) {
  const auto dimension = [](const std::vector<Vec3>& points) {
    return point_hull(on_grid(points)).dimension;
  };
  EXPECT_EQ(dimension({}), -1);
  EXPECT_EQ(dimension({Vec3(1, 2, 3), Vec3(1, 2, 3)}), 0);
  EXPECT_EQ(dimension({Vec3(0.0), Vec3(1), Vec3(2), Vec3(3)}), 1);
  EXPECT_EQ(dimension({Vec3(0.0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)}), 2);
  EXPECT_EQ(dimension(cube_points(1)), 3);
}

TEST(PointHull, OfAPlaneIsItsPolygon) {
  std::vector<Vec3> points;
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 3; ++y) points.emplace_back(x, y, x + 2 * y);
  }
  const PointHull hull = point_hull(on_grid(points));
  EXPECT_EQ(hull.dimension, 2);
  EXPECT_EQ(hull.corners.size(), 4u);
}

TEST(PointSolid, HasAFaceForEachPlane) {
  for (const double size : {1e-9, 0.3, 1.0, 7e5, 1e9}) {
    const auto cube = solid_of_points(cube_points(size));
    ASSERT_TRUE(cube);
    EXPECT_EQ(cube->primitive.polyhedron()->half_spaces().size(), 6u) << size;
    EXPECT_TRUE(csgcore::is_valid(cube->primitive));
  }
}

TEST(PointSolid, IsASheetOrNothingWithoutVolume) {
  const auto sheet =
      solid_of_points(std::vector<Vec3>{Vec3(0.0), Vec3(1, 0, 1), Vec3(0, 1, 1), Vec3(1, 1, 2)});
  ASSERT_TRUE(sheet);
  EXPECT_TRUE(sheet->is_sheet);
  EXPECT_TRUE(csgcore::is_valid(sheet->primitive));
  EXPECT_EQ(sheet->primitive.mesh()->triangles().size(), 2u);
  EXPECT_FALSE(sheet->primitive.mesh()->is_closed());
  EXPECT_FALSE(solid_of_points(std::vector<Vec3>{Vec3(0.0), Vec3(1, 2, 3), Vec3(2, 4, 6)}));
  EXPECT_FALSE(solid_of_points(std::vector<Vec3>(9, Vec3(5, 6, 7))));
}

std::vector<Vec3> vertices_of(const csgcore::Primitive& sheet) {
  std::vector<Vec3> result;
  for (const Vec3& vertex : sheet.mesh()->vertices()) {
    result.push_back(sheet.local_to_world.point(vertex));
  }
  return result;
}

/// Returns how far a point is outside of a sheet's convex polygon as seen from above, where its
/// vertices are in their order around it; at most 0 within.
double distance_beside(const std::vector<Vec3>& polygon, const Vec3& point) {
  const auto cross = [](const Vec3& a, const Vec3& b) { return a.x * b.y - a.y * b.x; };
  double area = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    area += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  double distance = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double beside = cross(point - polygon[i], edge) / std::hypot(edge.x, edge.y);
    distance = std::max(distance, area > 0 ? beside : -beside);
  }
  return distance;
}

TEST(PointSolid, OfNearlyFlatPointsIsTheirPolygon) {
  // OpenSCAD's issue1089: three of the points lie on a line but for rounding, so that the hull is a
  // tetrahedron, 1e-16 thick, whose faces meet anywhere.
  const std::vector<Vec3> points = {
      Vec3(-.249434174697079, -9.946811825017596, 7.668480694904858),
      Vec3(-.503165223042537, 8.896479509554647, .896037100784632),
      Vec3(-.503165223042537, -.666568050075708, 3.819754148011999),
      Vec3(-.503165223042537, -10.229615609706061, 6.743471195239366)};
  const auto hull = solid_of_points(points);
  ASSERT_TRUE(hull);
  EXPECT_TRUE(hull->is_sheet);
  EXPECT_TRUE(csgcore::is_valid(hull->primitive));
  const auto near = [](const Vec3& point) {
    return testing::Truly([=](const Vec3& at) { return glm::distance(at, point) < 1e-12; });
  };
  EXPECT_THAT(vertices_of(hull->primitive),
              testing::UnorderedElementsAre(near(points[0]), near(points[1]), near(points[3])));
}

TEST(PointSolid, OfNearlyFlatPointsHoldsThemHoweverCloseTheyAre) {
  for (uint32_t seed = 0; seed < 50; ++seed) {
    std::mt19937 engine(seed);
    const double noise = std::ldexp(1.0, -32 - static_cast<int>(seed % 20));
    std::uniform_real_distribution<double> offset(-noise, noise), place(-1, 1);
    std::vector<Vec3> points;
    for (int i = 0; i < 12; ++i) {
      const double x = place(engine), y = place(engine);
      for (int copy = 0; copy < 4; ++copy) {
        points.emplace_back(x + offset(engine), y + offset(engine),
                            0.3 * x - 0.7 * y + offset(engine));
      }
    }
    const auto hull = solid_of_points(points);
    ASSERT_TRUE(hull);
    EXPECT_TRUE(hull->is_sheet);
    EXPECT_TRUE(csgcore::is_valid(hull->primitive));
    const std::vector<Vec3> polygon = vertices_of(hull->primitive);
    for (const Vec3& point : points) EXPECT_LE(distance_beside(polygon, point), noise) << seed;
    csgcore::Box box;
    for (const Vec3& point : points) box.merge(point);
    EXPECT_GT(distance_beside(polygon, box.max + Vec3(1e-3, 1e-3, 0)), 0);
  }
  // Nearly on a line there is nothing to draw; a hundred times thicker than flat is a solid.
  std::vector<Vec3> line, thin;
  for (int i = 0; i < 8; ++i) {
    const double t = 0.125 * i;
    line.emplace_back(t, 2 * t + 1e-15 * (i % 2), -t + 1e-15 * (i % 3));
    thin.emplace_back(i % 2, (i / 2) % 2, 1e-7 * (i / 4));
  }
  EXPECT_FALSE(solid_of_points(line));
  const auto solid = solid_of_points(thin);
  ASSERT_TRUE(solid);
  EXPECT_FALSE(solid->is_sheet);
}

TEST(PointSolid, OfVeryManyPointsIsAMesh) {
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 point(normal(engine), normal(engine), normal(engine));
    points.push_back(point / std::sqrt(point.x * point.x + point.y * point.y + point.z * point.z));
  }
  const auto ball = solid_of_points(points);
  ASSERT_TRUE(ball);
  ASSERT_TRUE(ball->primitive.mesh());
  EXPECT_TRUE(ball->primitive.mesh()->is_closed());
}

}  // namespace
}  // namespace frontend
