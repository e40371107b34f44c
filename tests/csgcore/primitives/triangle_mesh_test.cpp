#include "csgcore/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>

#include "checks.hpp"
#include "csgcore/facets.hpp"
#include "primitives/mesh_edges.hpp"

namespace csgcore {
namespace {

using Triangle = TriangleMesh::Triangle;
using Triangles = std::vector<Triangle>;

Triangles fans_of(const Mesh& mesh) {
  Triangles triangles;
  for (const std::vector<uint32_t>& face : mesh.faces) {
    for (size_t i = 2; i < face.size(); ++i) {
      triangles.push_back({face[0], face[i - 1], face[i]});
    }
  }
  return triangles;
}

TriangleMesh ball(int fragments) {
  const Mesh mesh = sphere_mesh(2, fragments);
  return {mesh.vertices, fans_of(mesh)};
}

/// A box from −1 to 1 of 12 triangles.
Mesh unit_box() { return box_mesh({Vec3(-1.0), Vec3(1.0)}); }

void turn(Triangle& triangle) { std::swap(triangle[0], triangle[1]); }

TEST(OpenEdges, AreNoneOfAClosedMesh) {
  EXPECT_EQ(count_open_edges(fans_of(unit_box())), 0u);
  EXPECT_EQ(count_open_edges(Triangles{}), 0u);
}

TEST(OpenEdges, AreThoseOfAMissingTriangle) {
  Triangles triangles = fans_of(unit_box());
  triangles.pop_back();
  EXPECT_EQ(count_open_edges(triangles), 3u);
}

TEST(OpenEdges, MayBeSharedByManyIfTheyAreBalanced) {
  // Two boxes that share an edge, which four triangles meet.
  Triangles triangles = fans_of(unit_box());
  const size_t count = triangles.size();
  for (size_t i = 0; i < count; ++i) {
    Triangle other = triangles[i];
    for (uint32_t& vertex : other) vertex = vertex < 2 ? vertex : vertex + 8;
    triangles.push_back(other);
  }
  EXPECT_EQ(count_open_edges(triangles), 0u);
}

TEST(FaceAlike, KeepsTheMajority) {
  const Triangles right = fans_of(unit_box());
  Triangles triangles = right;
  turn(triangles[2]);
  turn(triangles[7]);
  face_alike(triangles);
  EXPECT_EQ(count_open_edges(triangles), 0u);
  EXPECT_EQ(triangles[0], right[0]);
  for (Triangle& triangle : triangles) turn(triangle);
  turn(triangles[5]);
  const Triangle first = triangles[0];
  face_alike(triangles);
  EXPECT_EQ(count_open_edges(triangles), 0u);
  EXPECT_EQ(triangles[0], first);
}

TEST(FaceAlike, TakesEachPartByItself) {
  Triangles triangles = fans_of(unit_box());
  const size_t count = triangles.size();
  for (size_t i = 0; i < count; ++i) {
    Triangle other = triangles[i];
    for (uint32_t& vertex : other) vertex += 8;
    turn(other);
    triangles.push_back(other);
  }
  const Triangles both = triangles;
  turn(triangles[1]);
  turn(triangles[count + 3]);
  face_alike(triangles);
  const auto by_vertices = [](Triangles list) {
    for (Triangle& t : list) std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    std::ranges::sort(list);
    return list;
  };
  EXPECT_EQ(by_vertices(triangles), by_vertices(both));
}

TEST(TriangleMesh, FacesAlikeIfItIsNotClosed) {
  const Mesh box = unit_box();
  Triangles triangles = fans_of(box);
  turn(triangles[4]);
  const TriangleMesh mesh(box.vertices, triangles);
  EXPECT_TRUE(mesh.is_closed());
  EXPECT_EQ(mesh.winding(Vec3(0.0)), 1);
}

TEST(TriangleMesh, LeavesOutTrianglesThatNameAVertexTwice) {
  const Mesh box = unit_box();
  Triangles triangles = fans_of(box);
  triangles.push_back({3, 3, 5});
  triangles.push_back({3, 5, 3});
  const TriangleMesh mesh(box.vertices, triangles);
  EXPECT_EQ(mesh.triangles().size(), 12u);
  EXPECT_TRUE(mesh.is_closed());
}

TEST(TriangleMesh, HasABoundingVolumeHierarchyOfAllItsTriangles) {
  for (const int fragments : {3, 5, 30, 200}) {
    const TriangleMesh mesh = ball(fragments);
    std::vector<int> visits(mesh.triangles().size());
    std::vector<uint32_t> open{0};
    while (!open.empty()) {
      const TriangleMesh::Node& node = mesh.nodes()[open.back()];
      open.pop_back();
      const auto expect_within = [&](const auto& low, const auto& high, float margin) {
        for (size_t axis = 0; axis < 3; ++axis) {
          EXPECT_LE(node.min[axis] + margin, low[axis]);
          EXPECT_GE(node.max[axis] - margin, high[axis]);
        }
      };
      if (node.count == 0) {
        for (const uint32_t child : {node.first, node.first + 1}) {
          ASSERT_LT(child, mesh.nodes().size());
          expect_within(mesh.nodes()[child].min, mesh.nodes()[child].max, 0);
          open.push_back(child);
        }
        continue;
      }
      EXPECT_LE(node.count, TriangleMesh::kLeafTriangles);
      for (uint32_t i = node.first; i < node.first + node.count; ++i) {
        ++visits[i];
        for (const uint32_t vertex : mesh.triangles()[i]) {
          const Vec3& v = mesh.canonical_vertices()[vertex];
          const std::array<double, 3> place{v.x, v.y, v.z};
          expect_within(place, place, 0.5f * TriangleMesh::kBoxMargin);
        }
      }
    }
    EXPECT_TRUE(std::ranges::all_of(visits, [](int count) { return count == 1; }));
  }
}

TEST(TriangleMesh, LiesInTheUnitBall) {
  for (const TriangleMesh& mesh :
       {ball(7), TriangleMesh({{5, 5, 5}, {6, 5, 5}, {5, 7, 5}}, {{0, 1, 2}})}) {
    for (size_t i = 0; i < mesh.vertices().size(); ++i) {
      const Vec3& place = mesh.canonical_vertices()[i];
      EXPECT_LE(glm::length(place), 1.0);
      const Vec3 local = mesh.canonical().center + mesh.canonical().scale * place;
      EXPECT_LT(glm::distance(local, mesh.vertices()[i]), 1e-15 * 10);
    }
  }
}

TEST(TriangleMesh, HasPlanesThroughItsTriangles) {
  const TriangleMesh mesh = ball(24);
  for (size_t i = 0; i < mesh.triangles().size(); ++i) {
    const TriangleMesh::Plane& plane = mesh.planes()[i];
    EXPECT_NEAR(glm::length(plane.normal), 1, 1e-15);
    EXPECT_GT(plane.offset, 0);  // the middle lies inside
    for (const uint32_t vertex : mesh.triangles()[i]) {
      EXPECT_NEAR(glm::dot(plane.normal, mesh.canonical_vertices()[vertex]), plane.offset, 1e-15);
    }
  }
}

TEST(TriangleMesh, GivesTrianglesWithoutAnAreaSomeNormalAcrossThem) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, {{0, 1, 2}});
  const Vec3 normal = mesh.planes()[0].normal;
  EXPECT_NEAR(glm::length(normal), 1, 1e-15);
  EXPECT_NEAR(glm::dot(normal, Vec3(1.0)), 0, 1e-15);
}

TEST(TriangleMesh, CountsWindings) {
  // A box within a box that faces the other way is a cavity; one that faces the same way is not.
  const Mesh box = unit_box();
  for (const bool is_cavity : {true, false}) {
    std::vector<Vec3> vertices = box.vertices;
    Triangles triangles = fans_of(box);
    for (Triangle triangle : fans_of(box)) {
      for (uint32_t& vertex : triangle) vertex += 8;
      if (is_cavity) turn(triangle);
      triangles.push_back(triangle);
    }
    for (const Vec3& vertex : box.vertices) vertices.push_back(0.5 * vertex);
    const TriangleMesh mesh(vertices, triangles);
    const double scale = mesh.canonical().scale.x;
    EXPECT_EQ(mesh.winding(Vec3(0.0)), is_cavity ? 0 : 2);
    EXPECT_EQ(mesh.winding(Vec3(0.75, 0, 0) / scale), 1);
    EXPECT_EQ(mesh.winding(Vec3(-0.75, 0, 0) / scale), 1);
    EXPECT_EQ(mesh.winding(Vec3(1.25, 0, 0) / scale), 0);
    EXPECT_EQ(mesh.winding(Vec3(-1.25, 0, 0) / scale), 0);
  }
}

TEST(TriangleMesh, HasTheVertexThatIsFurthest) {
  const TriangleMesh mesh = ball(50);
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3 direction = checks::random_point(random, {Vec3(-1.0), Vec3(1.0)});
    double furthest = -10;
    for (const Vec3& v : mesh.canonical_vertices()) {
      furthest = std::max(furthest, glm::dot(v, direction));
    }
    EXPECT_EQ(glm::dot(mesh.support(direction), direction), furthest);
  }
}

TEST(TriangleMesh, HasTheColorsOfItsFaces) {
  const Mesh faces = sphere_mesh(2, 12);
  Triangles triangles;
  std::vector<std::optional<Color>> colors;
  std::map<Triangle, std::optional<Color>> color_of;
  for (const Triangle& triangle : fans_of(faces)) {
    // Beside each triangle is one that is left out.
    triangles.push_back({triangle[0], triangle[0], triangle[1]});
    colors.push_back(Color{9, 9, 9, 1});
    triangles.push_back(triangle);
    colors.push_back(Color{static_cast<float>(triangles.size()), 0, 0, 1});
    if (triangles.size() % 7 == 0) colors.back().reset();
    color_of[triangle] = colors.back();
  }
  const TriangleMesh mesh(faces.vertices, triangles, colors);
  ASSERT_EQ(mesh.triangles().size(), color_of.size());
  ASSERT_EQ(mesh.colors().size(), color_of.size());
  for (size_t i = 0; i < mesh.triangles().size(); ++i) {
    const Triangle& triangle = mesh.triangles()[i];
    EXPECT_EQ(mesh.colors()[i], color_of[triangle]);
    Vec3 middle(0.0);
    for (const uint32_t vertex : triangle) middle += mesh.canonical_vertices()[vertex] / 3.0;
    EXPECT_EQ(mesh.color_at(middle + 1e-9 * mesh.planes()[i].normal), color_of[triangle]);
  }
  EXPECT_EQ(mesh.color_at(Vec3(0.0)), std::nullopt) << "far from the surface";
  EXPECT_EQ(ball(12).color_at(Vec3(1, 0, 0)), std::nullopt);
  EXPECT_FALSE(same_mesh(&mesh, std::make_unique<TriangleMesh>(faces.vertices, triangles).get()));
}

TEST(TriangleMesh, IsTheSameByContent) {
  const TriangleMesh a = ball(9), b = ball(9), c = ball(10);
  EXPECT_TRUE(same_mesh(&a, &b));
  EXPECT_FALSE(same_mesh(&a, &c));
  EXPECT_FALSE(same_mesh(&a, nullptr));
  EXPECT_TRUE(same_mesh(nullptr, nullptr));
}

TEST(TriangleMesh, IsNothingWithoutTriangles) {
  const auto flat =
      std::make_shared<TriangleMesh>(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}, Triangles{{0, 1, 1}});
  EXPECT_FALSE(is_valid(make_mesh(flat)));
  EXPECT_FALSE(is_valid(make_mesh(nullptr)));
}

TEST(MeshCells, AreDecidedWhereNoFaceIs) {
  const auto mesh = std::make_shared<TriangleMesh>(ball(40));
  Affine map;
  map.linear = Mat3(Vec3(3, 0, 0), Vec3(0, 0, 2), Vec3(1, -1, 0));
  map.translation = {4, 5, 6};
  const CanonicalPrimitive primitive = canonicalize(make_mesh(mesh, map));
  const auto cell = [&](const Vec3& center, double half) {
    return classify(primitive, {map.point(center) - Vec3(half), map.point(center) + Vec3(half)});
  };
  EXPECT_EQ(cell({0, 0, 0}, 0.5), Classification::kInside);
  EXPECT_EQ(cell({1.5, 0, 0}, 0.1), Classification::kInside);
  EXPECT_EQ(cell({2, 0, 0}, 0.1), Classification::kCrosses);
  EXPECT_EQ(cell({1.6, 1.6, 0}, 0.1), Classification::kOutside);
  EXPECT_EQ(cell({0, 0, 9}, 0.5), Classification::kOutside);
}

TEST(MeshCells, AreInsideOfNoOpenMesh) {
  const Mesh box = unit_box();
  Triangles triangles = fans_of(box);
  triangles.pop_back();
  const auto mesh = std::make_shared<TriangleMesh>(box.vertices, triangles);
  const CanonicalPrimitive primitive = canonicalize(make_mesh(mesh));
  EXPECT_EQ(classify(primitive, {Vec3(-0.1), Vec3(0.1)}), Classification::kCrosses);
  EXPECT_EQ(classify(primitive, {Vec3(1.1), Vec3(1.2)}), Classification::kOutside);
}

}  // namespace
}  // namespace csgcore
