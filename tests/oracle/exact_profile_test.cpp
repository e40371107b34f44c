// Tests exact rays through extrusions and revolutions against other primitives that are the same
// solids, and where the crossings are known.
#include <gtest/gtest.h>

#include <cstdio>
#include <glm/geometric.hpp>
#include <random>

#include "csgcore/polyhedron.hpp"
#include "csgcore/profile.hpp"
#include "oracle/exact_rays.hpp"
#include "support/models.hpp"
#include "support/test_profiles.hpp"

namespace oracle {
namespace {

using csgcore::make_extrusion;
using csgcore::make_revolution;
using csgcore::Op;
using csgcore::Primitive;
using csgcore::ProfileEdge;
using csgcore::Projection;
using csgcore::Scene;
using csgcore::Vec2;
using csgcore::Vec3;
using test_support::circle_loop;
using test_support::profile_of;
using test_support::rectangle_loop;

struct Pair {
  const char* name;
  Primitive profile, other;
};

/// A half disc on the axis.
test_support::ProfileLoop half_disc(double radius) {
  return {{.kind = ProfileEdge::Kind::kArc, .end = {0, radius}, .control = {0, 0}},
          {.end = {0, -radius}}};
}

std::vector<Pair> pairs() {
  const auto disc = profile_of({circle_loop({0, 0}, 3)});
  return {
      {"brick", make_extrusion(profile_of({rectangle_loop({-1, -2}, {3, 1})}), -1, 2),
       csgcore::make_polyhedron(csgcore::Polyhedron::box({{-1, -2, -1}, {3, 1, 2}}))},
      {"rod", make_extrusion(disc, -1, 2), csgcore::make_frustum(-1, 2, 3, 3)},
      {"cone", make_extrusion(disc, -1, 2, 1, 0), csgcore::make_frustum(-1, 2, 3, 0)},
      {"frustum", make_extrusion(disc, -1, 2, 0.25, 0.5), csgcore::make_frustum(-1, 2, 0.75, 1.5)},
      {"turned_rod", make_revolution(profile_of({rectangle_loop({0, -1}, {3, 2})})),
       csgcore::make_frustum(-1, 2, 3, 3)},
      {"turned_cone",
       make_revolution(profile_of({test_support::polygon_loop({{0, -1}, {3, -1}, {0, 2}})})),
       csgcore::make_frustum(-1, 2, 3, 0)},
      {"ball", make_revolution(profile_of({half_disc(3)})), csgcore::make_sphere(3)}};
}

TEST(ExactProfile, IsTheSameSolidAsOtherPrimitives) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-4, 4);
  for (const Pair& pair : pairs()) {
    SCOPED_TRACE(pair.name);
    int hits = 0, wrong = 0;
    for (int map = 0; map < 5; ++map) {
      Pair placed = pair;
      if (map > 0) placed.profile.local_to_world = test_support::random_affine(random);
      placed.other.local_to_world = placed.profile.local_to_world;
      const Scene profile = test_support::scene_of(Op::kUnion, {placed.profile});
      const Scene other = test_support::scene_of(Op::kUnion, {placed.other});
      // A solid less itself is empty: its faces coincide exactly.
      const Scene nothing = test_support::scene_of(Op::kDifference, {placed.profile, placed.other});
      const ExactScene scenes[] = {ExactScene(profile), ExactScene(other), ExactScene(nothing)};
      EXPECT_NEAR(scenes[0].size(), scenes[1].size(), 1e-14 * scenes[1].size());
      ExactRays a(scenes[0]), b(scenes[1]), c(scenes[2]);
      for (int i = 0; i < 60; ++i) {
        const Vec3 origin{number(random), number(random), number(random)};
        const Vec3 target{number(random), number(random), number(random)};
        const csgcore::Ray ray{placed.other.local_to_world.point(origin),
                               placed.other.local_to_world.direction(0.5 * target - origin)};
        const ExactHit found = a.first_hit(ray, Projection::kOrthographic);
        const ExactHit expected = b.first_hit(ray, Projection::kOrthographic);
        hits += found.hit();
        ASSERT_EQ(found.hit(), expected.hit());
        wrong += c.first_hit(ray, Projection::kOrthographic).hit();
        if (!found.hit()) continue;
        ASSERT_EQ(found.s.lower, expected.s.lower);
        ASSERT_EQ(found.s.upper, expected.s.upper);
        ASSERT_LE(glm::length(found.normal - expected.normal), 1e-9);
      }
    }
    EXPECT_GT(hits, 60);
    EXPECT_EQ(wrong, 0);
  }
}

TEST(ExactProfile, IsInsideAlongTheAxis) {
  const Scene scene =
      test_support::scene_of(Op::kUnion, {make_revolution(profile_of({half_disc(3)}))});
  const ExactScene exact(scene);
  ExactRays rays(exact);
  const ExactHit hit = rays.first_hit({{0, 0, 9}, {0, 0, -1}}, Projection::kPerspective);
  EXPECT_DOUBLE_EQ(hit.s.lower, 6);
  EXPECT_EQ(hit.normal, Vec3(0, 0, 1));
}

TEST(ExactProfile, MeetsATorusWhereItIs) {
  const Scene scene =
      test_support::scene_of(Op::kUnion, {make_revolution(profile_of({circle_loop({3, 0}, 1)}))});
  const ExactScene exact(scene);
  ExactRays rays(exact);
  const auto hit = [&](const Vec3& origin, const Vec3& direction) {
    return rays.first_hit({origin, direction}, Projection::kPerspective);
  };
  EXPECT_DOUBLE_EQ(hit({-10, 0, 0}, {1, 0, 0}).s.lower, 6);
  EXPECT_DOUBLE_EQ(hit({0, 0, 0}, {1, 0, 0}).s.lower, 2);
  EXPECT_EQ(hit({0, 0, 0}, {1, 0, 0}).normal, Vec3(-1, 0, 0));
  EXPECT_DOUBLE_EQ(hit({0, 3, 9}, {0, 0, -1}).s.lower, 8);
  EXPECT_FALSE(hit({0, 0, 9}, {0, 0, -1}).hit());
  // Across the hole: x² = 4² − 2.5².
  EXPECT_NEAR(hit({-10, 2.5, 0}, {1, 0, 0}).s.lower, 10 - std::sqrt(9.75), 1e-14);
}

}  // namespace
}  // namespace oracle
