// Tests what the exact ray oracle says of triangle meshes: segments, ties at edges and vertices,
// cavities, overlapping shells, and the sheets of open meshes.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "oracle/exact_rays.hpp"
#include "support/reference_test_scenes.hpp"
#include "support/test_meshes.hpp"

namespace oracle {
namespace {

using csgcore::Op;
using csgcore::Projection;
using csgcore::Ray;
using csgcore::Scene;
using csgcore::Vec3;
using csgcore::reference_test::ball;
using csgcore::reference_test::rod;
using csgcore::reference_test::scene_of;
using test_support::box_parts;
using test_support::MeshParts;

csgcore::Primitive mesh(const MeshParts& parts) { return csgcore::make_mesh(parts.mesh()); }

ExactHit hit_of(const Scene& scene, const Ray& ray,
                Projection projection = Projection::kOrthographic) {
  return ExactRays(ExactScene(scene)).first_hit(ray, projection);
}

void expect_near(const Vec3& normal, const Vec3& expected) {
  EXPECT_NEAR(glm::distance(normal, expected), 0, 1e-15);
}

Ray down_at(double x, double y) { return {{x, y, 10}, {0, 0, -1}}; }

/// Two walls of thickness 1 along the x axis, 2 apart, on a floor of that thickness.
MeshParts trough() {
  return {
      {{0, 0, 0},
       {4, 0, 0},
       {4, 0, 4},
       {3, 0, 4},
       {3, 0, 1},
       {1, 0, 1},
       {1, 0, 4},
       {0, 0, 4},
       {0, 9, 0},
       {4, 9, 0},
       {4, 9, 4},
       {3, 9, 4},
       {3, 9, 1},
       {1, 9, 1},
       {1, 9, 4},
       {0, 9, 4}},
      {{0, 1, 4},   {1, 2, 4},    {2, 3, 4},   {0, 4, 5},   {0, 5, 7},    {5, 6, 7},   {8, 12, 9},
       {9, 12, 10}, {10, 12, 11}, {8, 13, 12}, {8, 15, 13}, {13, 15, 14}, {0, 9, 1},   {0, 8, 9},
       {1, 10, 2},  {1, 9, 10},   {2, 11, 3},  {2, 10, 11}, {3, 12, 4},   {3, 11, 12}, {4, 13, 5},
       {4, 12, 13}, {5, 14, 6},   {5, 13, 14}, {6, 15, 7},  {6, 14, 15},  {7, 8, 0},   {7, 15, 8}}};
}

TEST(ExactMesh, IsMetInSeveralSegments) {
  const Ray along_x{{-5, 4.5, 3}, {1, 0, 0}};
  const csgcore::Primitive solid = mesh(trough());
  ASSERT_TRUE(solid.mesh()->is_closed());
  const ExactHit first = hit_of(scene_of(Op::kUnion, {solid}), along_x);
  EXPECT_EQ(first.s.lower, 5);
  EXPECT_EQ(first.s.upper, 5);
  expect_near(first.normal, Vec3(-1, 0, 0));
  // From between the walls, and from within one of them.
  EXPECT_EQ(hit_of(scene_of(Op::kUnion, {solid}), {{2, 4, 3}, {1, 0, 0}}, Projection::kPerspective)
                .position,
            Vec3(3, 4, 3));
  const ExactHit inside =
      hit_of(scene_of(Op::kUnion, {solid}), {{0.5, 4, 3}, {1, 0, 0}}, Projection::kPerspective);
  EXPECT_EQ(inside.position, Vec3(1, 4, 3));
  expect_near(inside.normal, Vec3(1, 0, 0));
  // Cut from a ball, it leaves what is between the walls.
  const ExactHit left = hit_of(scene_of(Op::kDifference, {ball(1.5, {2, 4.5, 3}), solid}), along_x);
  EXPECT_EQ(left.primitive, 1u);
  EXPECT_EQ(left.position, Vec3(1, 4.5, 3));
  expect_near(left.normal, Vec3(-1, 0, 0));
}

TEST(ExactMesh, TiesAreBrokenAlikeForAllTriangles) {
  // Rays through vertices, along edges and diagonals, and in faces of boxes: what is in front of
  // the box is hit or not, but nothing shines through it.
  const MeshParts box = box_parts(Vec3(-1), Vec3(1));
  const Scene scene = scene_of(Op::kUnion, {mesh(box)});
  for (double x = -0.75; x < 1; x += 0.25) {
    for (double y = -0.75; y < 1; y += 0.25) {
      const ExactHit hit = hit_of(scene, down_at(x, y));
      ASSERT_TRUE(hit.hit());
      EXPECT_EQ(hit.s.lower, 9);
      expect_near(hit.normal, Vec3(0, 0, 1));
      ASSERT_TRUE(hit_of(scene, {{2 * x, 2 * y, 3}, {-x, -y, -2}}).hit());
    }
  }
  for (const Vec3& vertex : box.vertices) {
    const ExactHit hit = hit_of(scene, {2.0 * vertex, -vertex});
    EXPECT_EQ(hit.position, vertex);
    EXPECT_EQ(hit.s.lower, 1);
  }
  // Of two boxes side by side a ray in their common face meets one, in one of either direction.
  MeshParts both = box;
  both.add(box_parts({1, -1, -1}, {3, 1, 1}));
  EXPECT_EQ(hit_of(scene_of(Op::kUnion, {mesh(both)}), down_at(1, 0.5)).s.lower, 9);
  EXPECT_EQ(hit_of(scene_of(Op::kUnion, {mesh(both)}), down_at(1, 1 - 0x1p-40)).s.lower, 9);
}

TEST(ExactMesh, SeesWhatADoubleCannotTell) {
  // Rays past the ridge of a roof by 2⁻¹⁰⁰ of its size meet one of its sides.
  const MeshParts roof{
      {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, -1, 1}, {0, 1, 1}},
      {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {2, 3, 5}, {1, 2, 5}, {1, 5, 4}, {3, 0, 4}, {3, 4, 5}}};
  const Scene scene = scene_of(Op::kUnion, {mesh(roof)});
  for (const double side : {-1, 1}) {
    const ExactHit hit = hit_of(scene, down_at(side * 0x1p-100, 0.25));
    EXPECT_NEAR(glm::distance(hit.normal, Vec3(side, 0, 1) / std::sqrt(2.0)), 0, 1e-15);
  }
  EXPECT_TRUE(hit_of(scene, down_at(1 - 0x1p-20, 0)).hit());
  EXPECT_FALSE(hit_of(scene, down_at(1 + 0x1p-50, 0)).hit());
}

TEST(ExactMesh, ShellsAreUnitedAndCavitiesAreHollow) {
  MeshParts parts = box_parts(Vec3(-4), Vec3(4));
  parts.add(box_parts({0, -1, -1}, {9, 1, 1}));                 // overlaps the first
  parts.add(box_parts({-3, -3, -3}, {-1, 3, 3}).inside_out());  // a cavity
  for (const MeshParts& either : {parts, parts.inside_out()}) {
    const Scene scene = scene_of(Op::kUnion, {mesh(either)});
    EXPECT_EQ(hit_of(scene, {{20, 0, 0}, {-1, 0, 0}}).position, Vec3(9, 0, 0));
    expect_near(hit_of(scene, {{20, 0, 0}, {-1, 0, 0}}).normal, Vec3(1, 0, 0));
    // Within the overlap there is no face.
    const ExactHit out = hit_of(scene, {{-0.5, 0, 0}, {1, 0, 0}}, Projection::kPerspective);
    EXPECT_EQ(out.position, Vec3(9, 0, 0));
    expect_near(out.normal, Vec3(1, 0, 0));
    const ExactHit hollow = hit_of(scene, {{-2, 0, 0}, {1, 0, 0}}, Projection::kPerspective);
    EXPECT_EQ(hollow.position, Vec3(-1, 0, 0));
    expect_near(hollow.normal, Vec3(-1, 0, 0));
  }
}

TEST(ExactMesh, AHoleShowsASheet) {
  MeshParts open = box_parts(Vec3(-4), Vec3(4));
  std::erase_if(open.triangles, [&](const csgcore::TriangleMesh::Triangle& t) {
    return open.vertices[t[0]].z > 0 && open.vertices[t[1]].z > 0 && open.vertices[t[2]].z > 0;
  });
  const csgcore::Primitive box = mesh(open);
  ASSERT_FALSE(box.mesh()->is_closed());
  const Scene scene = scene_of(Op::kUnion, {box});
  const double tau = ExactScene(scene).thickness();
  // Through the hole one sees the bottom from within; a ray through two sides sees a solid.
  const ExactHit bottom = hit_of(scene, down_at(1, 2));
  EXPECT_EQ(bottom.position, Vec3(1, 2, -4));
  expect_near(bottom.normal, Vec3(0, 0, 1));
  EXPECT_EQ(hit_of(scene, {{-9, 0, 0}, {1, 0, 0}}).position, Vec3(-4, 0, 0));
  // The sheet ends 4 τ behind the triangle, along its normal.
  const Scene beneath = scene_of(Op::kDifference, {rod(-9, 9, 3), box});
  const Vec3 through = glm::normalize(Vec3(1, 0, -1));
  const ExactHit back = hit_of(beneath, {{-3, 0, 0}, {1, 0, -1}}, Projection::kPerspective);
  EXPECT_EQ(back.position, Vec3(1, 0, -4));
  const ExactHit behind = hit_of(scene_of(Op::kIntersection, {rod(-9, 9, 3), box}),
                                 {{1 + 2e-8, 0, -4 - 2e-8}, -through}, Projection::kPerspective);
  EXPECT_NEAR(behind.position.z, -4, 1e-15);
  const ExactHit inverse = hit_of(scene, {{1, 0, -4 - tau}, {0, 0, -1}}, Projection::kPerspective);
  EXPECT_NEAR(inverse.position.z, -4 - 4 * tau, 1e-15);
  expect_near(inverse.normal, Vec3(0, 0, -1));
}

TEST(ExactMesh, DoubtIsNextToEdges) {
  const Scene scene = scene_of(Op::kUnion, {mesh(test_support::icosphere_parts(1, 1))});
  const ExactScene prepared(scene);
  ExactRays own(prepared);
  const Vec3 vertex = test_support::icosphere_parts(1, 1).vertices[3];
  EXPECT_EQ(own.doubt({3.0 * vertex, -vertex}, Projection::kOrthographic), Doubt::kSilhouette);
  const Vec3 aside{0.02, 0.03, 0.01};
  EXPECT_EQ(own.doubt({3.0 * vertex + aside, -vertex}, Projection::kOrthographic), Doubt::kNone);
  // A diagonal of a plane face is no edge.
  const Scene box = scene_of(Op::kUnion, {mesh(box_parts(Vec3(-1), Vec3(1)))});
  const ExactScene prepared_box(box);
  EXPECT_EQ(ExactRays(prepared_box).doubt(down_at(0.5, 0.5), Projection::kOrthographic),
            Doubt::kNone);
}

}  // namespace
}  // namespace oracle
