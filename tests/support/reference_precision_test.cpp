// Tests the reference's precision, its single rays, and its tree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "evaluate_tree.hpp"
#include "models.hpp"
#include "reference_test_scenes.hpp"
#include "reference_tree.hpp"

namespace csgcore {
namespace {

using reference_test::ball;
using reference_test::down;
using reference_test::middle_hit;
using reference_test::rod;
using reference_test::scene_of;

// --- Precision ---

TEST(ReferencePrecision, FarEyesAndFarModels) {
  const Scene near = scene_of(Op::kUnion, {make_frustum(0, 1, 1, 0.25), ball(0.5, {0, 0, 1})});
  for (const double distance : {1e3, 1e9, 1e12}) {
    View view = down(distance);
    view.half_height = 1.5 / distance;
    view.width_px = view.height_px = 97;
    Scene far = near;
    View far_view = view;
    const Vec3 offset{0x1p40, -0x1p41, 0x1p42};
    for (Primitive& p : far.primitives) p.local_to_world.translation += offset;
    far_view.eye = view.eye + offset;  // exact: integers
    const std::vector<ReferenceHit> a = Reference(near, view).picture();
    const std::vector<ReferenceHit> b = Reference(far, far_view).picture();
    int hits = 0;
    for (size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].primitive, b[i].primitive);
      if (!a[i].hit()) continue;
      ++hits;
      ASSERT_LT(glm::length(a[i].normal - b[i].normal), 1e-15L);
      // The hit is on the surface, to extended precision, however far away the eye is.
      const LongVec3& p = a[i].position;
      const Real off = a[i].primitive == 1
                           ? glm::length(p - LongVec3(0, 0, 1)) - 0.5L
                           : std::min(std::abs(p.z), std::hypot(p.x, p.y) - (1 - 0.75L * p.z));
      ASSERT_LT(std::abs(off), 1e-17L) << distance;
    }
    EXPECT_GT(hits, 2000);
  }
}

TEST(ReferencePrecision, Needles) {
  // A rod 1e7 times as long as thick, seen at 45° from the side: the wall is in its place.
  const Scene scene = scene_of(Op::kUnion, {rod(-5e5, 5e5, 0.05)});
  View view = down(9, Projection::kOrthographic);
  view.eye = {3e5, 0, 4e5};
  view.forward = glm::normalize(Vec3(-1, 0, -1));
  view.right = {0, -1, 0};
  view.up = glm::cross(view.right, view.forward);
  view.half_height = 0.05;
  view.width_px = view.height_px = 16;
  int hits = 0;
  for (const ReferenceHit& hit : Reference(scene, view).picture()) {
    if (!hit.hit()) continue;
    ++hits;
    ASSERT_LT(std::abs(std::hypot(hit.position.x, hit.position.y) - 0.05L), 1e-13L);
  }
  EXPECT_GT(hits, 100);
}

// --- Single rays ---

TEST(ReferenceRays, SinglePixelsAreThoseOfThePicture) {
  const Scene scene = test_support::random_tree(40, 5);
  View view = down(30);
  view.half_height = 0.4;
  view.width_px = 61;
  view.height_px = 47;
  const Reference reference(scene, view);
  const std::vector<ReferenceHit> picture = reference.picture();
  int hits = 0;
  for (uint32_t i = 0; i < picture.size(); ++i) {
    const ReferenceHit hit = reference.at(i % 61, i / 61);
    ASSERT_EQ(hit.primitive, picture[i].primitive);
    ASSERT_EQ(hit.s, picture[i].s);
    ASSERT_EQ(hit.normal, picture[i].normal);
    hits += hit.hit();
  }
  EXPECT_GT(hits, 300);
}

TEST(ReferenceRays, UndecidedIsWhereNeighboursAtTheDisplacementDiffer) {
  // The silhouette at x = 1 passes the ray of pixel 2 by some displacements, or by less than one.
  View view = down(5, Projection::kOrthographic);
  view.width_px = view.height_px = 3;
  view.half_height = 1.5;
  const auto undecided = [&](double displacements) {
    Scene scene = scene_of(Op::kUnion, {rod(-1, 1, 1)});
    const double step = double(Reference(scene, view).displacement());
    EXPECT_LT(step, 1e-11);
    scene.primitives[0].local_to_world.translation.x = displacements * step;
    return Reference(scene, view).undecided(2, 1);
  };
  EXPECT_TRUE(undecided(0.5));
  EXPECT_TRUE(undecided(-0.5));
  EXPECT_FALSE(undecided(2));
  EXPECT_FALSE(undecided(-2));
  // Inside a face nothing is undecided; where two rods touch, the ray is.
  const Scene edge = scene_of(Op::kUnion, {rod(-1, 0, 1, {0, -1, 0}), rod(-1, 0, 1, {0, 1, 0})});
  EXPECT_FALSE(Reference(edge, view).undecided(1, 0));
  EXPECT_TRUE(Reference(edge, view).undecided(1, 1));
  // The face is at the tolerance from the eye, so that rounding may put it before or behind that.
  const Scene block = scene_of(Op::kUnion, {rod(-1, 1, 1)});
  const double tolerance = kReferenceThickness * Reference(block, down(1)).model_size();
  EXPECT_FALSE(Reference(block, down(1)).undecided(1, 1));
  EXPECT_TRUE(Reference(block, down(1 + tolerance)).undecided(1, 1));
}

// --- The counting tree ---

TEST(ReferenceTree, CountsAsTheTreeEvaluates) {
  int changes = 0;
  for (uint32_t seed = 1; seed <= 50; ++seed) {
    const Scene scene = test_support::random_tree(3 + seed, seed);
    const std::span<const CsgToken> tokens = scene.model.tokens();
    reference::CountingTree tree(tokens);
    std::vector<bool> inside(scene.primitives.size());
    std::mt19937 random(seed);
    for (int i = 0; i < 300 && !tree.slots().empty(); ++i) {
      const uint32_t slot = uint32_t(random() % tree.slots().size());
      const bool before = tree.value();
      tree.flip(slot);
      inside[tree.slots()[slot]] = !inside[tree.slots()[slot]];
      ASSERT_EQ(tree.inside(slot), inside[tree.slots()[slot]]);
      ASSERT_EQ(tree.value(),
                test_support::evaluate_tree(tokens, [&](uint32_t p) { return inside[p]; }))
          << "seed " << seed << ", step " << i;
      changes += tree.value() != before;
    }
  }
  EXPECT_GT(changes, 300);
}

TEST(ReferenceTree, AnEmptyTreeHoldsNowhere) {
  EXPECT_FALSE(reference::CountingTree({}).value());
  const Scene nothing;
  EXPECT_FALSE(middle_hit(nothing, down(1)).hit());
}

}  // namespace
}  // namespace csgcore
