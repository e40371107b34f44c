// Tests what is measured of surfaces, and of pairs of them; and which primitive a cut shows.
#include "surface.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "csgcore/polyhedron.hpp"
#include "csgcore/profile.hpp"
#include "section_plane.hpp"

namespace window {
namespace {

using csgcore::Affine;
using csgcore::Mat3;
using csgcore::Vec2;
using csgcore::Vec3;
using testing::ElementsAre;
using testing::IsEmpty;

/// Turns about x by 90 degrees, doubles and moves: z becomes -y.
const Affine kMap{2.0 * Mat3{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, {10, 20, 30}};

void expect_near(const Vec3& a, const Vec3& b) { EXPECT_LE(glm::length(a - b), 1e-9); }

TEST(Surface, OfASphereHasACentre) {
  const Surface surface = surface_at(csgcore::make_sphere(3, kMap), {16, 20, 30}, Vec3(1, 0, 0));
  EXPECT_EQ(surface.kind, Surface::Kind::kCenter);
  EXPECT_NEAR(surface.radius, 6, 1e-9);
  expect_near(surface.origin, {10, 20, 30});
  EXPECT_THAT(words_of(surface), ElementsAre("radius 6", "centre [10, 20, 30]"));
}

TEST(Surface, OfAFrustumHasAnAxisAndRoundEnds) {
  const csgcore::Primitive cone = csgcore::make_frustum(0, 4, 3, 1, kMap);
  // Half way up, at local (2, 0, 2).
  const Surface side = surface_at(cone, {14, 16, 30}, glm::normalize(Vec3(2, -1, 0)));
  EXPECT_EQ(side.kind, Surface::Kind::kAxis);
  EXPECT_NEAR(side.radius, 4, 1e-9);
  expect_near(side.origin, {10, 16, 30});
  expect_near(side.direction, {0, -1, 0});
  EXPECT_THAT(words_of(side), ElementsAre("radius 4", "axis [0, -1, 0]", "centre [10, 16, 30]"));
  // At local (1, 0, 0): seen from within, as the end of a hole.
  const Surface end = surface_at(cone, {12, 20, 30}, Vec3(0, -1, 0));
  EXPECT_EQ(end.kind, Surface::Kind::kPlane);
  EXPECT_NEAR(end.radius, 6, 1e-9);
  expect_near(end.origin, {10, 20, 30});
  EXPECT_THAT(words_of(end), ElementsAre("round face, radius 6", "centre [10, 20, 30]"));
}

TEST(Surface, WhatIsStretchedIsNotRound) {
  const Affine stretched{Mat3{{2, 0, 0}, {0, 1, 0}, {0, 0, 1}}, Vec3(0)};
  EXPECT_EQ(surface_at(csgcore::make_sphere(1, stretched), {2, 0, 0}, Vec3(1, 0, 0)).kind,
            Surface::Kind::kOther);
  const csgcore::Primitive cylinder = csgcore::make_frustum(0, 1, 1, 1, stretched);
  EXPECT_EQ(surface_at(cylinder, {2, 0, 0.5}, Vec3(1, 0, 0)).kind, Surface::Kind::kOther);
  const Surface end = surface_at(cylinder, {1, 0, 1}, Vec3(0, 0, 1));
  EXPECT_EQ(end.kind, Surface::Kind::kPlane);
  EXPECT_EQ(end.radius, 0);
  EXPECT_THAT(words_of(end), ElementsAre("flat, normal [0, 0, 1]"));
  EXPECT_THAT(words_of({}), IsEmpty());
}

/// A square from (0, 0) to (2, 2), with a hole of radius 0.5 in its middle.
std::shared_ptr<const csgcore::Profile> plate() {
  using Kind = csgcore::ProfileEdge::Kind;
  const csgcore::ProfileLoop square = {{Kind::kLine, true, {2, 0}, {}},
                                       {Kind::kLine, true, {2, 2}, {}},
                                       {Kind::kLine, true, {0, 2}, {}},
                                       {Kind::kLine, true, {0, 0}, {}}};
  const csgcore::ProfileLoop hole = {{Kind::kArc, false, {0.5, 1}, {1, 1}},
                                     {Kind::kArc, false, {1.5, 1}, {1, 1}}};
  return std::make_shared<csgcore::Profile>(std::vector{square, hole}, csgcore::FillRule::kEvenOdd);
}

TEST(Surface, OfAnExtrusionIsRoundWhereItsEdgeIs) {
  const csgcore::Primitive solid = csgcore::make_extrusion(plate(), 0, 5);
  const Surface hole = surface_at(solid, {1, 1.5, 3}, Vec3(0, -1, 0));
  EXPECT_EQ(hole.kind, Surface::Kind::kAxis);
  EXPECT_NEAR(hole.radius, 0.5, 1e-9);
  expect_near(hole.origin, {1, 1, 3});
  EXPECT_EQ(surface_at(solid, {2, 1.2, 3}, Vec3(1, 0, 0)).kind, Surface::Kind::kPlane);
  EXPECT_EQ(surface_at(solid, {0.1, 0.1, 5}, Vec3(0, 0, 1)).kind, Surface::Kind::kPlane);
}

TEST(Surface, ObliqueConesAndShearedCylindersAreNotRound) {
  // At the middle of its height the hole has radius 0.375, about (0.75, 0.75).
  const csgcore::Primitive tapered = csgcore::make_extrusion(plate(), 0, 4, 1, 0.5);
  EXPECT_EQ(surface_at(tapered, {0.75, 1.125, 2}, glm::normalize(Vec3(0, -1, 0.1))).kind,
            Surface::Kind::kOther);
  const Affine sheared{Mat3{{1, 0, 0}, {0, 1, 0}, {0.5, 0, 1}}, Vec3(0)};
  const csgcore::Primitive leaning = csgcore::make_frustum(0, 4, 1, 1, sheared);
  EXPECT_EQ(surface_at(leaning, {1, 1, 2}, Vec3(0, 1, 0)).kind, Surface::Kind::kOther);
}

TEST(Surface, OfARevolutionHasItsAxis) {
  using Kind = csgcore::ProfileEdge::Kind;
  // A half disc of radius 2 at the axis: a ball.
  const auto half_disc = std::make_shared<csgcore::Profile>(
      std::vector<csgcore::ProfileLoop>{
          {{Kind::kArc, true, {0, 2}, {0, 0}}, {Kind::kLine, true, {0, -2}, {}}}},
      csgcore::FillRule::kNonZero);
  const Surface ball = surface_at(csgcore::make_revolution(half_disc), {2, 0, 0}, Vec3(1, 0, 0));
  EXPECT_EQ(ball.kind, Surface::Kind::kCenter);
  EXPECT_NEAR(ball.radius, 2, 1e-9);
  // The plate turned about its left edge: its outer side is a cylinder of radius 2.
  const Surface drum = surface_at(csgcore::make_revolution(plate()), {0, 2, 1.2}, Vec3(0, 1, 0));
  EXPECT_EQ(drum.kind, Surface::Kind::kAxis);
  EXPECT_NEAR(drum.radius, 2, 1e-9);
  expect_near(drum.origin, {0, 0, 1.2});
}

Surface plane(const Vec3& origin, const Vec3& normal) {
  return {Surface::Kind::kPlane, origin, glm::normalize(normal), 0};
}
Surface axis(const Vec3& origin, const Vec3& direction) {
  return {Surface::Kind::kAxis, origin, glm::normalize(direction), 1};
}
Surface center(const Vec3& origin) { return {Surface::Kind::kCenter, origin, Vec3(0), 1}; }

Surface edge(const Vec3& origin, const Vec3& direction) {
  return {Surface::Kind::kEdge, origin, glm::normalize(direction), 0, 7};
}
Surface vertex(const Vec3& origin) { return {Surface::Kind::kVertex, origin}; }
Surface circle(const Vec3& origin, const Vec3& direction) {
  return {Surface::Kind::kCircle, origin, glm::normalize(direction), 1};
}

TEST(Surface, RelationsOfEdgesAndVertices) {
  const Vec3 x(1, 0, 0), z(0, 0, 1);
  EXPECT_EQ(relation_of(edge({0, 0, 1}, z), edge({3, 4, 7}, z)), "edges 5 apart");
  EXPECT_EQ(relation_of(edge({0, 0, 1}, z), edge({0, 0, 7}, -z)), "the same line");
  EXPECT_EQ(relation_of(edge({0, 0, 1}, x), axis({3, 4, 7}, z)), "edge and axis at 90°, 4 apart");
  EXPECT_EQ(relation_of(circle({0, 0, 1}, z), axis({3, 4, 7}, z)), "axes 5 apart");
  EXPECT_EQ(relation_of(edge({3, 4, 7}, x), plane({0, 0, 1}, z)), "edge 6 from the face");
  EXPECT_EQ(relation_of(vertex({3, 4, 7}), plane({0, 0, 1}, z)), "vertex 6 from the face");
  EXPECT_EQ(relation_of(vertex({3, 4, 7}), edge({0, 0, 1}, z)), "vertex 5 from the edge");
  EXPECT_EQ(relation_of(vertex({3, 4, 7}), vertex({3, 4, 8})), "vertices 1 apart");
  EXPECT_EQ(relation_of(center({3, 4, 7}), vertex({3, 4, 8})), "centre and vertex 1 apart");
}

/// The walls of a cone, of the hole of an extrusion, and of a drum; in world space.
TEST(Surface, RoundWallsAreThoseOfCylindersAndCones) {
  const std::vector<RoundWall> cone = round_walls(csgcore::make_frustum(0, 4, 3, 1, kMap));
  ASSERT_EQ(cone.size(), 1u);
  expect_near(cone[0].centers[0], {10, 20, 30});
  expect_near(cone[0].centers[1], {10, 12, 30});
  EXPECT_EQ(cone[0].radii, (std::array{6.0, 2.0}));
  const std::vector<RoundWall> hole = round_walls(csgcore::make_extrusion(plate(), 0, 5));
  ASSERT_EQ(hole.size(), 2u);  // two half circles
  expect_near(hole[0].centers[1], {1, 1, 5});
  EXPECT_EQ(hole[0].radii, (std::array{0.5, 0.5}));
  const std::vector<RoundWall> drum = round_walls(csgcore::make_revolution(plate()));
  ASSERT_EQ(drum.size(), 2u);  // the inner one is the axis itself
  EXPECT_EQ(drum[0].radii, (std::array{2.0, 2.0}));
  const Affine stretched{Mat3{{2, 0, 0}, {0, 1, 0}, {0, 0, 1}}, Vec3(0)};
  EXPECT_THAT(round_walls(csgcore::make_frustum(0, 1, 1, 1, stretched)), IsEmpty());
  EXPECT_THAT(round_walls(csgcore::make_sphere(3)), IsEmpty());
}

TEST(Surface, RelationsAreThoseThatOneMeasures) {
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_EQ(relation_of(plane({0, 0, 1}, -z), plane({5, 5, 13}, z)), "parallel faces, 12 apart");
  EXPECT_EQ(relation_of(plane({0, 0, 1.5}, z), plane({5, 5, 1.5 + 1e-15}, z)), "the same plane");
  EXPECT_EQ(relation_of(plane({0, 0, 1}, z), plane({5, 5, 13}, x + z)), "faces at 45°");
  EXPECT_EQ(relation_of(axis({0, 0, 1}, z), axis({3, 4, 7}, -z)), "axes 5 apart");
  EXPECT_EQ(relation_of(axis({0, 0, 1}, z), axis({0, 0, 7}, z)), "the same axis");
  EXPECT_EQ(relation_of(axis({0, 0, 1}, z), axis({3, 4, 7}, x)), "axes at 90°, 4 apart");
  EXPECT_EQ(relation_of(center({0, 0, 0}), center({3, 4, 0})), "centres 5 apart");
  EXPECT_EQ(relation_of(plane({0, 0, 1}, z), axis({3, 4, 7}, y)), "axis 6 from the face");
  EXPECT_EQ(relation_of(axis({3, 4, 7}, z), plane({0, 0, 1}, z)), "axis at 90° to the face");
  EXPECT_EQ(relation_of(center({3, 4, 7}), plane({0, 0, 1}, z)), "centre 6 from the face");
  EXPECT_EQ(relation_of(center({3, 4, 7}), axis({0, 0, 1}, z)), "centre 5 from the axis");
  EXPECT_EQ(relation_of(center({3, 4, 7}), {}), std::nullopt);
}

TEST(PrimitiveAround, IsOneThatIsLeftThere) {
  csgcore::CsgTreeBuilder builder;  // (0 - 1) + (2 & 3)
  builder.open(csgcore::Op::kDifference);
  builder.primitive(0);
  builder.primitive(1);
  builder.close();
  builder.open(csgcore::Op::kIntersection);
  builder.primitive(2);
  builder.primitive(3);
  builder.close();
  const csgcore::CsgTree tree = builder.finish();
  const auto around = [&tree](const std::set<uint32_t>& those) {
    return primitive_around(tree, [&](uint32_t primitive) { return those.contains(primitive); });
  };
  EXPECT_EQ(around({}), std::nullopt);
  EXPECT_EQ(around({0}), 0u);
  EXPECT_EQ(around({0, 1}), std::nullopt);
  EXPECT_EQ(around({0, 1, 2, 3}), 2u);
  EXPECT_EQ(around({3}), std::nullopt);
  EXPECT_EQ(around({0, 2, 3}), 2u) << "of a union the last one is seen";
  EXPECT_EQ(primitive_around({}, [](uint32_t) { return true; }), std::nullopt);
}

}  // namespace
}  // namespace window
