// Tests the exact ray oracle against the long-double reference of tests/support, two formulations
// of one definition. They may differ only where a ray is undecided. It also tests the exact twin of
// every kind of primitive against csgcore's own crossings.
#include <gtest/gtest.h>

#include <cstdio>
#include <glm/geometric.hpp>

#include "csgcore/solid.hpp"
#include "csgcore/tracer.hpp"
#include "oracle/exact_rays.hpp"
#include "support/full_run.hpp"
#include "support/kinds/test_kind.hpp"
#include "support/models.hpp"
#include "support/reference.hpp"

namespace oracle {
namespace {

using csgcore::Projection;
using csgcore::Scene;
using csgcore::Vec3;
using csgcore::View;

/// Returns a view towards the middle of the box, from `distance` diagonals away in a direction.
View view_of(const Scene& scene, const Vec3& towards_eye, double distance, Projection projection) {
  const csgcore::Box box = csgcore::reference_box(scene);
  View view;
  view.projection = projection;
  view.forward = -glm::normalize(towards_eye);
  view.right = glm::normalize(glm::cross(view.forward, Vec3(0.1, 0.2, 0.9)));
  view.up = glm::cross(view.right, view.forward);
  view.eye = box.center() - distance * box.diagonal() * view.forward;
  const bool perspective = projection == Projection::kPerspective;
  view.half_height = perspective ? 0.5 / std::max(distance, 0.5) : 0.5 * box.diagonal();
  view.width_px = 72;
  view.height_px = 54;
  return view;
}

struct Agreement {
  uint64_t rays = 0, hits = 0, undecided = 0;
  ExactCounts counts;
};

void expect_agreement(const Scene& scene, const View& view, Agreement& sum) {
  const csgcore::Reference reference(scene, view);
  const std::vector<csgcore::ReferenceHit> expected = reference.picture();
  const ExactScene prepared(scene);
  ExactRays rays(prepared);
  for (size_t i = 0; i < expected.size(); ++i) {
    const auto x = uint32_t(i % view.width_px), y = uint32_t(i / view.width_px);
    const csgcore::Ray ray = csgcore::pixel_ray(view, x, y);
    const ExactHit hit = rays.first_hit(ray, view.projection);
    const csgcore::LongVec3 position(hit.position), normal(hit.normal);
    const bool same =
        hit.primitive == expected[i].primitive &&
        glm::length(position - expected[i].position) <= kExactPositionError * prepared.size() &&
        glm::length(normal - expected[i].normal) <= kExactNormalError;
    ++sum.rays;
    sum.hits += hit.hit();
    if (same) {
      if (hit.hit()) {
        // Positions and parameters agree to the rounding of doubles, except at grazing angles.
        const double squarely = std::abs(glm::dot(hit.normal, glm::normalize(ray.direction)));
        const double rounding = 1e-14 * (glm::length(hit.position) + prepared.size());
        ASSERT_LE(double(glm::length(position - expected[i].position)) * squarely, rounding);
        ASSERT_GE(expected[i].s, hit.s.lower - rounding / squarely);
        ASSERT_LE(expected[i].s, hit.s.upper + rounding / squarely);
      }
      continue;
    }
    ++sum.undecided;
    EXPECT_NE(rays.doubt(ray, view.projection), Doubt::kNone) << "pixel " << x << ", " << y;
  }
  sum.counts.add(rays.counts());
}

TEST(ExactAgreement, WithTheReferenceOnRandomTrees) {
  Agreement sum;
  const uint32_t seeds = test_support::full_run() ? 200 : 10;
  for (uint32_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = test_support::random_tree_of_all_kinds(3 + seed % 40, seed);
    if (csgcore::reference_box(scene).empty()) continue;
    const Vec3 aside{1.0 + seed % 3, -2.0 + seed % 5, 1.5};
    expect_agreement(scene, view_of(scene, aside, 2, Projection::kPerspective), sum);
    expect_agreement(scene, view_of(scene, aside, 0.1, Projection::kPerspective), sum);
    expect_agreement(scene, view_of(scene, {0, 0, 1}, 1e6, Projection::kOrthographic), sum);
  }
  EXPECT_GT(sum.hits, sum.rays / 20);
  EXPECT_EQ(sum.undecided, 0u);
  // Almost no crossing of random solids needs more than doubles.
  EXPECT_GT(sum.counts.segments, sum.rays / 2);
  EXPECT_LT(sum.counts.exact_segments, sum.counts.segments / 100);
  EXPECT_LT(sum.counts.exact_comparisons, sum.counts.comparisons / 10000);
  std::printf("%s: %llu rays, %llu hits; of %llu segments %llu exact, of %llu comparisons %llu\n",
              test_support::full_run() ? "full run" : "sample", (unsigned long long)sum.rays,
              (unsigned long long)sum.hits, (unsigned long long)sum.counts.segments,
              (unsigned long long)sum.counts.exact_segments,
              (unsigned long long)sum.counts.comparisons,
              (unsigned long long)sum.counts.exact_comparisons);
}

/// Some primitives of a variant: one is cut by another, beside a third.
Scene scene_of(const test_support::Variant& variant, std::mt19937& random) {
  test_support::Sizes sizes(random, {.low = 0.5, .high = 2, .most_fragments = 12});
  Scene scene;
  for (uint32_t id = 0; id < 3; ++id) {
    csgcore::Primitive primitive = variant.make(sizes);
    primitive.local_to_world = test_support::random_affine(random);
    primitive.local_to_world.translation *= 0.15;  // so that they overlap
    primitive.id = id;
    scene.primitives.push_back(primitive);
  }
  csgcore::CsgTreeBuilder tree;
  tree.open(csgcore::Op::kUnion);
  tree.open(csgcore::Op::kDifference);
  tree.primitive(0);
  tree.primitive(1);
  tree.close();
  tree.primitive(2);
  tree.close();
  scene.model = tree.finish();
  return scene;
}

/// Compares what csgcore's rays show with the exact twins.
void expect_hits_of_csgcore(const Scene& scene, const View& view) {
  const csgcore::Solid solid(csgcore::canonical_primitives(scene), scene.model);
  csgcore::Hits hits;
  csgcore::TraceStats stats;
  csgcore::trace(solid, view, csgcore::TraceOptions{}, hits, stats);
  const ExactScene prepared(scene);
  ExactRays rays(prepared);
  for (size_t i = 0; i < hits.primitive.size(); ++i) {
    const csgcore::Ray ray =
        csgcore::pixel_ray(view, double(i % view.width_px), double(i / view.width_px));
    const ExactHit hit = rays.first_hit(ray, view.projection);
    const bool same =
        hits.primitive[i] == hit.primitive &&
        glm::length(hits.position[i] - hit.position) <= kExactPositionError * prepared.size() &&
        glm::length(hits.normal[i] - hit.normal) <= kExactNormalError;
    if (same) continue;
    EXPECT_NE(rays.doubt(ray, view.projection), Doubt::kNone) << "pixel " << i;
  }
}

class ExactAgreementOf : public testing::TestWithParam<test_support::Variant> {};

TEST_P(ExactAgreementOf, WithTheReferenceAndCsgcore) {
  std::mt19937 random(1);
  Agreement sum;
  for (int round = 0; round < (test_support::full_run() ? 40 : 4); ++round) {
    SCOPED_TRACE(round);
    const Scene scene = scene_of(GetParam(), random);
    const Vec3 aside = Vec3{0.5, -0.3, 0.4} + test_support::random_direction(random);
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      const View view = view_of(scene, aside, 2, projection);
      expect_agreement(scene, view, sum);
      expect_hits_of_csgcore(scene, view);
    }
  }
  EXPECT_GT(sum.hits, sum.rays / 20);
  EXPECT_LE(sum.undecided, sum.rays / 10000);
}

INSTANTIATE_TEST_SUITE_P(, ExactAgreementOf, testing::ValuesIn(test_support::all_variants()),
                         [](const auto& instance) { return instance.param.name; });

TEST(ExactAgreement, WithTheReferenceOnThousandsOfPrimitives) {
  Agreement sum;
  for (const Scene& scene :
       {test_support::cylinder_minus_spheres(2000), test_support::cylinder_minus_cones(2000)}) {
    expect_agreement(scene, view_of(scene, {1, 2, 1.5}, 2, Projection::kPerspective), sum);
  }
  EXPECT_GT(sum.hits, 2000u);
  EXPECT_EQ(sum.undecided, 0u);
}

TEST(ExactAgreement, PicturesDoNotDependOnThreads) {
  const Scene scene = test_support::random_tree(30, 5);
  const View view = view_of(scene, {1, 1, 1}, 2, Projection::kPerspective);
  const ExactScene prepared(scene);
  ExactCounts counts;
  const std::vector<ExactHit> picture = exact_picture(prepared, view, &counts);
  EXPECT_EQ(counts.rays, picture.size());
  ExactRays rays(prepared);
  uint64_t hits = 0;
  for (size_t i = 0; i < picture.size(); ++i) {
    const csgcore::Ray ray =
        csgcore::pixel_ray(view, double(i % view.width_px), double(i / view.width_px));
    const ExactHit hit = rays.first_hit(ray, view.projection);
    ASSERT_EQ(hit.primitive, picture[i].primitive);
    ASSERT_EQ(hit.s.lower, picture[i].s.lower);
    ASSERT_EQ(hit.position, picture[i].position);
    ASSERT_EQ(hit.normal, picture[i].normal);
    hits += hit.hit();
  }
  EXPECT_GT(hits, 200u);
}

}  // namespace
}  // namespace oracle
