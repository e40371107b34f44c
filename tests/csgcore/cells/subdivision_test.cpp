#include "csgcore/subdivision.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <thread>
#include <tuple>

#include "checks.hpp"
#include "support/full_run.hpp"
#include "support/models.hpp"

namespace csgcore {
namespace {

Solid solid_of(const Scene& scene) { return Solid(canonical_primitives(scene), scene.model); }

SubdivisionOptions options_of(uint32_t leaf_primitives, SplitRule split = SplitRule::kSurfaceArea) {
  SubdivisionOptions options;
  options.leaf_primitives = leaf_primitives;
  options.split = split;
  options.threads = 1;
  return options;
}

class SubdivisionBy : public testing::TestWithParam<std::tuple<uint32_t, SplitRule>> {
 protected:
  SubdivisionOptions options() const {
    return options_of(std::get<0>(GetParam()), std::get<1>(GetParam()));
  }
};

TEST_P(SubdivisionBy, RandomTreesKeepTheirMeaning) {
  for (uint32_t seed = 0; seed < test_support::sample_size(12); ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = test_support::random_tree_of_all_kinds(4 + 3 * seed, seed);
    const Solid solid = solid_of(scene);
    const Subdivision subdivision(solid, options());
    checks::expect_correct(subdivision, scene, 2);
  }
}

TEST_P(SubdivisionBy, ModelsKeepTheirMeaning) {
  for (const Scene& scene :
       {test_support::cylinder_minus_spheres(100), test_support::cylinder_minus_cones(60)}) {
    const Solid solid = solid_of(scene);
    const Subdivision subdivision(solid, options());
    checks::expect_correct(subdivision, scene, 2);
    EXPECT_GT(subdivision.leaves().size(), 10u);
  }
}

INSTANTIATE_TEST_SUITE_P(KAndRule, SubdivisionBy,
                         testing::Combine(testing::Values(1, 2, 4, 6, 8, 16),
                                          testing::Values(SplitRule::kCyclic,
                                                          SplitRule::kSurfaceArea)));

TEST(Subdivision, FunctionHoldsBeyondTheCellByTheOverlap) {
  const Scene scene = test_support::cylinder_minus_spheres(300);
  const Solid solid = solid_of(scene);
  const Subdivision subdivision(solid, options_of(4));
  EXPECT_EQ(subdivision.overlap(), cell_overlap(solid.bounds()));
  EXPECT_GT(subdivision.overlap(), 0);
  std::mt19937 random(1);
  const double overlap = subdivision.overlap();
  for (const Leaf& leaf : subdivision.leaves()) {
    for (int i = 0; i < 6; ++i) {
      Vec3 point = checks::random_point(random, leaf.box);
      const double beyond = checks::uniform(random, 0, 0.999) * overlap;
      point[i % 3] = i < 3 ? leaf.box.min[i % 3] - beyond : leaf.box.max[i % 3] + beyond;
      ASSERT_EQ(checks::holds(subdivision, leaf, point), checks::holds(scene, point));
    }
  }
}

/// A sphere that ends short of a cell by less than the overlap is in the cell's Blist; one that
/// ends further away is not.
TEST(Subdivision, WhatIsWithinTheOverlapCounts) {
  for (const bool within : {true, false}) {
    const double overlap = cell_overlap({Vec3(-3.0), Vec3(3.0)});
    const double gap = within ? 0.5 * overlap : 2 * overlap;
    std::vector<Primitive> spheres;
    for (const double x : {-2.0, -2.0, 1 + gap, 2.0}) {
      const double y = spheres.empty() ? -2 : (spheres.size() == 1 ? 2 : 0);
      spheres.push_back(make_sphere(1, {Mat3{1.0}, {x, y, 0}}));
    }
    spheres.push_back(make_sphere(1, {Mat3{1.0}, {2, 0, 2}}));
    spheres.push_back(make_sphere(1, {Mat3{1.0}, {2, 0, -2}}));
    const Scene scene = checks::scene_of(Op::kUnion, spheres);
    const Solid solid = solid_of(scene);
    ASSERT_EQ(solid.bounds().center(), Vec3(0.0));
    const Subdivision subdivision(solid, options_of(3, SplitRule::kCyclic));  // divided at x = 0
    const Leaf* leaf = subdivision.find({-1e-9, 0, 0});
    ASSERT_NE(leaf, nullptr);
    ASSERT_EQ(leaf->box.max.x, 0);
    bool found = false;
    for (const BlistTest& test : subdivision.tests_of(*leaf)) found |= test.primitive == 2;
    EXPECT_EQ(found, within);
  }
}

class PaperRule : public testing::TestWithParam<double> {};

TEST_P(PaperRule, KeepsTheMeaningOfWhatIsNotDropped) {
  for (Scene scene : {test_support::cylinder_minus_spheres(100),
                      test_support::cylinder_minus_cones(60), test_support::random_tree(20, 3)}) {
    const Solid solid = solid_of(scene);
    const View view = checks::view_of(solid.bounds(), {0, 1, 0}, 4 * solid.bounds().diagonal());
    auto options = SubdivisionOptions::paper(GetParam(), view);
    options.threads = 1;
    const Subdivision subdivision(solid, options);
    checks::expect_correct(subdivision, scene, 2);
    const LeafCensus counts = census(subdivision);
    EXPECT_EQ(counts.by_kind[size_t(LeafKind::kGeneral)], 0u);
    EXPECT_GT(counts.by_kind[size_t(LeafKind::kDropped)], 0u);
    EXPECT_EQ(counts.leaves(), subdivision.leaves().size());
  }
}

INSTANTIATE_TEST_SUITE_P(Thresholds, PaperRule, testing::Values(1.0, 4.0, 20.0));

TEST(Subdivision, PaperRuleStopsAtUnionsOfAnyNumber) {
  std::vector<Primitive> spheres;
  for (int i = 0; i < 20; ++i) spheres.push_back(make_sphere(1, {Mat3{1.0}, {0.1 * i, 0, 0}}));
  const Scene scene = checks::scene_of(Op::kUnion, spheres);
  const Solid solid = solid_of(scene);
  auto options = SubdivisionOptions::paper(1, checks::view_of(solid.bounds(), {0, 1, 0}, 20));
  const Subdivision paper(solid, options);
  ASSERT_EQ(paper.leaves().size(), 1u);
  EXPECT_EQ(paper.leaves()[0].kind, LeafKind::kUnion);
  EXPECT_EQ(paper.leaves()[0].test_count, 20u);
  options.stop_at_unions = false;
  EXPECT_GT(Subdivision(solid, options).leaves().size(), 20u);
}

TEST(Subdivision, CyclicRuleHalvesTheAxesInTurn) {
  const Scene scene = test_support::cylinder_minus_spheres(100);
  const Solid solid = solid_of(scene);
  const Subdivision subdivision(solid, options_of(4, SplitRule::kCyclic));
  const auto nodes = subdivision.nodes();
  const KdNode& root = nodes[0];
  EXPECT_EQ(root.axis, 0u);
  EXPECT_EQ(root.split, subdivision.root_box().center().x);
  EXPECT_EQ(nodes[root.below].axis, 1u);
  EXPECT_EQ(nodes[nodes[root.below].above].axis, 2u);
}

TEST(Subdivision, SurfaceAreaRuleNeedsFewerCells) {
  for (const Scene& scene :
       {test_support::cylinder_minus_spheres(1000), test_support::cylinder_minus_cones(200)}) {
    const Solid solid = solid_of(scene);
    const Subdivision cyclic(solid, options_of(8, SplitRule::kCyclic));
    const Subdivision area(solid, options_of(8));
    EXPECT_LT(census(area).tests, census(cyclic).tests);
  }
}

template <typename T>
std::vector<T> copy_of(std::span<const T> items) {
  return {items.begin(), items.end()};
}

auto tuple_of(const Leaf& leaf) {
  return std::make_tuple(leaf.box.min.x, leaf.box.min.y, leaf.box.min.z, leaf.box.max.x,
                         leaf.box.max.y, leaf.box.max.z, leaf.first_test, leaf.test_count,
                         leaf.kind, leaf.solid);
}

void expect_same(const Subdivision& a, const Subdivision& b) {
  ASSERT_EQ(a.nodes().size(), b.nodes().size());
  for (size_t i = 0; i < a.nodes().size(); ++i) {
    const KdNode &x = a.nodes()[i], &y = b.nodes()[i];
    ASSERT_EQ(std::tie(x.split, x.axis, x.below, x.above),
              std::tie(y.split, y.axis, y.below, y.above));
  }
  ASSERT_EQ(a.leaves().size(), b.leaves().size());
  for (size_t i = 0; i < a.leaves().size(); ++i) {
    ASSERT_EQ(tuple_of(a.leaves()[i]), tuple_of(b.leaves()[i]));
  }
  ASSERT_EQ(copy_of(a.tests()), copy_of(b.tests()));
}

TEST(Subdivision, IsTheSameForEveryNumberOfThreads) {
  for (const Scene& scene :
       {test_support::cylinder_minus_spheres(3000), test_support::random_tree(1500, 5)}) {
    const Solid solid = solid_of(scene);
    for (const bool paper : {false, true}) {
      SubdivisionOptions options = options_of(8);
      if (paper) {
        options = SubdivisionOptions::paper(
            8, checks::view_of(solid.bounds(), {0, 1, 0}, 4 * solid.bounds().diagonal()));
      }
      options.threads = 1;
      const Subdivision one(solid, options);
      const Subdivision one_by_tasks(solid, options, [](const LeafBatch&) {});
      expect_same(one, one_by_tasks);
      for (const unsigned threads : {2u, 3u, 8u, 0u}) {
        options.threads = threads;
        expect_same(one, Subdivision(solid, options));
      }
    }
  }
}

TEST(Subdivision, BatchesDeliverItsLeaves) {
  for (const uint32_t n : {3u, 100u, 3000u}) {
    const Scene scene = test_support::cylinder_minus_spheres(n);
    const Solid solid = solid_of(scene);
    for (const unsigned threads : {1u, 8u}) {
      SubdivisionOptions options = options_of(8);
      options.threads = threads;
      std::vector<std::pair<decltype(tuple_of(Leaf{})), std::vector<BlistTest>>> delivered, kept;
      const auto add = [](auto& list, Leaf leaf, std::span<const BlistTest> tests) {
        const auto own = tests.subspan(leaf.first_test, leaf.test_count);
        leaf.first_test = 0;
        list.emplace_back(tuple_of(leaf), copy_of(own));
      };
      int batches = 0;
      std::atomic<int> inside = 0;
      const Subdivision subdivision(solid, options, [&](const LeafBatch& batch) {
        EXPECT_EQ(inside.fetch_add(1), 0) << "two calls at a time";
        for (const Leaf& leaf : batch.leaves) add(delivered, leaf, batch.tests);
        ++batches;
        std::this_thread::sleep_for(std::chrono::microseconds(200));  // long enough to show a
                                                                      // second call
        inside.fetch_sub(1);
      });
      for (const Leaf& leaf : subdivision.leaves()) add(kept, leaf, subdivision.tests());
      const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
      std::sort(delivered.begin(), delivered.end(), before);
      std::sort(kept.begin(), kept.end(), before);
      EXPECT_EQ(delivered, kept);
      if (n == 3000) {
        EXPECT_GT(batches, 5);
      }
    }
  }
}

TEST(Subdivision, RefineFollowsTheView) {
  const Scene scene = test_support::cylinder_minus_spheres(200);
  const Solid solid = solid_of(scene);
  const Vec3 direction{0, 1, 0};
  const View far = checks::view_of(solid.bounds(), direction, 400);
  auto options = SubdivisionOptions::paper(2, far);
  options.threads = 1;
  Subdivision subdivision(solid, options);
  EXPECT_FALSE(subdivision.refine(far));
  const std::vector<Leaf> before = copy_of(subdivision.leaves());
  const uint64_t dropped = census(subdivision).by_kind[size_t(LeafKind::kDropped)];
  ASSERT_GT(dropped, 0u);

  View previous = far;
  for (const double distance : {150.0, 60.0}) {
    const View near = checks::view_of(solid.bounds(), direction, distance);
    EXPECT_TRUE(subdivision.refine(near));
    EXPECT_FALSE(subdivision.refine(near));
    for (const Leaf& leaf : subdivision.leaves()) {
      if (leaf.kind != LeafKind::kDropped) continue;
      ASSERT_LT(projected_size_px(near, leaf.box), options.threshold_px);
    }
    checks::expect_correct(subdivision, scene, 2);
    previous = near;
  }
  EXPECT_GT(census(subdivision).by_kind[size_t(LeafKind::kReplaced)], 0u);
  // Leaves keep their indices.
  ASSERT_GT(subdivision.leaves().size(), before.size());
  for (size_t i = 0; i < before.size(); ++i) {
    if (subdivision.leaves()[i].kind == LeafKind::kReplaced) {
      ASSERT_EQ(before[i].kind, LeafKind::kDropped);
    } else {
      ASSERT_EQ(tuple_of(subdivision.leaves()[i]), tuple_of(before[i]));
    }
  }
  // The cells equal those of a subdivision made for the near view from the start.
  options.view = previous;
  const Subdivision fresh(solid, options);
  EXPECT_EQ(census(fresh).leaves(), census(subdivision).leaves());
  EXPECT_EQ(census(fresh).tests, census(subdivision).tests);
  // All nodes are part of the tree.
  std::vector<int> seen(subdivision.nodes().size());
  for (const KdNode& node : subdivision.nodes()) {
    if (node.axis == KdNode::kLeafAxis) continue;
    ++seen[node.below];
    ++seen[node.above];
  }
  EXPECT_EQ(seen[0], 0);
  EXPECT_THAT(std::span(seen).subspan(1), testing::Each(1));
}

TEST(Subdivision, RefineWithoutThresholdDoesNothing) {
  const Scene scene = test_support::cylinder_minus_spheres(20);
  const Solid solid = solid_of(scene);
  Subdivision subdivision(solid, options_of(8));
  EXPECT_FALSE(subdivision.refine(checks::view_of(solid.bounds(), {0, 1, 0}, 10)));
}

TEST(Subdivision, FindOutsideTheRootBox) {
  const Scene scene = test_support::cylinder_minus_spheres(20);
  const Solid solid = solid_of(scene);
  const Subdivision subdivision(solid, options_of(8));
  EXPECT_EQ(subdivision.find({100, 0, 0}), nullptr);
  EXPECT_EQ(subdivision.find({0, 0, std::nan("")}), nullptr);
  EXPECT_NE(subdivision.find({0, 0, 0}), nullptr);
  EXPECT_GE(subdivision.bytes(), subdivision.leaves().size() * sizeof(Leaf));
}

TEST(Solid, BoundsFollowTheOperations) {
  const Primitive left = make_sphere(1), right = make_sphere(1, {Mat3{1.0}, {1, 0, 0}});
  const Primitive away = make_sphere(1, {Mat3{1.0}, {5, 0, 0}});
  EXPECT_EQ(solid_of(checks::scene_of(Op::kUnion, {left, away})).bounds().max, Vec3(6, 1, 1));
  EXPECT_EQ(solid_of(checks::scene_of(Op::kDifference, {left, right})).bounds().max, Vec3(1, 1, 1));
  const Box both = solid_of(checks::scene_of(Op::kIntersection, {left, right})).bounds();
  EXPECT_EQ(both.min, Vec3(0, -1, -1));
  EXPECT_EQ(both.max, Vec3(1, 1, 1));
  EXPECT_TRUE(solid_of(checks::scene_of(Op::kIntersection, {left, away})).bounds().empty());
  EXPECT_TRUE(solid_of(Scene{}).bounds().empty());
  EXPECT_FALSE(solid_of(Scene{}).contains({0, 0, 0}));
}

}  // namespace
}  // namespace csgcore
