// Tests the cost of a subdivision where surfaces meet in curves and faces that no cell separates.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "checks.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/subdivision.hpp"
#include "support/models.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

constexpr double kPi = std::numbers::pi;

Affine moved(const Vec3& place) { return {Mat3{1.0}, place}; }

Affine turned_about_z(double angle, const Vec3& place = Vec3{0.0}) {
  const double c = std::cos(angle), s = std::sin(angle);
  const Mat3 turn{c, s, 0, -s, c, 0, 0, 0, 1};
  return {turn, turn * place};
}

Primitive box(const Vec3& low, const Vec3& high, const Affine& map = {}) {
  return make_polyhedron(Polyhedron::box({low, high}), map);
}

/// A block minus the other primitives.
Scene cut_from_a_block(std::vector<Primitive> cuts, double half = 25) {
  cuts.insert(cuts.begin(), box(Vec3(-half), Vec3(half)));
  return checks::scene_of(Op::kDifference, std::move(cuts));
}

Scene vase() { return test_support::stacked_frusta(60); }

/// Cubes on one face, side by side.
Scene cubes_on_a_face() {
  std::vector<Primitive> cubes;
  for (int i = 0; i < 40; ++i) {
    cubes.push_back(box({0, 0, 0.1 * i}, {10, 10, 10 + 0.1 * i}));
  }
  return cut_from_a_block(std::move(cubes));
}

/// Plates with flush tops and bottoms.
Scene plates() {
  std::vector<Primitive> plates;
  for (int i = 0; i < 50; ++i) {
    plates.push_back(box({0, 0, 20}, {30, 30, 25}, moved({0.4 * i - 25, 0.3 * i - 20, 0})));
  }
  return cut_from_a_block(std::move(plates));
}

Scene bars_about_an_axis() {
  std::vector<Primitive> bars;
  for (int i = 0; i < 180; ++i) {
    bars.push_back(box({-20, -2, 20}, {20, 2, 25}, turned_about_z(i * kPi / 90)));
  }
  return cut_from_a_block(std::move(bars));
}

/// Tubes of one length, one inside the other.
Scene nested_cylinders() {
  Scene scene;
  CsgTreeBuilder tree;
  tree.open(Op::kUnion);
  for (uint32_t i = 0; i < 100; ++i) {
    tree.open(Op::kDifference);
    for (const double inwards : {0.0, 0.05}) {
      tree.primitive(static_cast<uint32_t>(scene.primitives.size()));
      scene.primitives.push_back(
          make_frustum(0, 10, 20 - 0.1 * i - inwards, 20 - 0.1 * i - inwards));
    }
    tree.close();
  }
  tree.close();
  scene.model = tree.finish();
  return scene;
}

/// Balls whose surfaces all contain one circle.
Scene balls_through_a_circle() {
  std::vector<Primitive> balls;
  for (int i = -15; i <= 15; ++i) {
    balls.push_back(make_sphere(std::hypot(10, i / 3.0), moved({0, 0, i / 3.0})));
  }
  return cut_from_a_block(std::move(balls), 18);
}

/// Cones with one apex.
Scene cones_from_a_point() {
  std::vector<Primitive> cones;
  for (int i = 0; i < 100; ++i) {
    const double polar = std::acos(1 - 2 * (i + 0.5) / 100);
    const double c = std::cos(polar), s = std::sin(polar);
    const Affine turn = turned_about_z(2.39996 * i);
    const Mat3 tilt{c, 0, -s, 0, 1, 0, s, 0, c};
    cones.push_back(make_frustum(0, 24, 0, 4, {turn.linear * tilt, Vec3(0.0)}));
  }
  return cut_from_a_block(std::move(cones));
}

/// Three sets of slots, whose planes meet in thousands of points.
Scene lattice() {
  std::vector<Primitive> walls;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = -8; i < 8; ++i) {
      Vec3 low(-24.0), high(24.0);
      low[axis] = 3 * i;
      high[axis] = 3 * i + 1.5;
      walls.push_back(box(low, high));
    }
  }
  return cut_from_a_block(std::move(walls), 26);
}

struct Family {
  const char* name;
  Scene (*make)();
};

/// Options for a picture of 640×480 that the solid fills.
SubdivisionOptions options_of(const Solid& solid, uint32_t leaf_primitives, double threshold_px) {
  const View view =
      checks::view_of(solid.bounds(), {0.48, 0.64, -0.6}, 3 * solid.bounds().diagonal());
  SubdivisionOptions options;
  if (leaf_primitives == 2) {
    options = SubdivisionOptions::paper(threshold_px, view);
  } else {
    options.leaf_primitives = leaf_primitives;
    options.threshold_px = threshold_px;
    options.view = view;
  }
  options.threads = 1;
  return options;
}

uint64_t given_up(const Subdivision& subdivision) {
  return census(subdivision).by_kind[static_cast<size_t>(LeafKind::kGivenUp)];
}

bool same_cells(const Subdivision& a, const Subdivision& b) {
  return std::equal(a.nodes().begin(), a.nodes().end(), b.nodes().begin(), b.nodes().end(),
                    [](const KdNode& x, const KdNode& y) {
                      return std::tie(x.split, x.axis, x.below, x.above) ==
                             std::tie(y.split, y.axis, y.below, y.above);
                    }) &&
         std::equal(a.leaves().begin(), a.leaves().end(), b.leaves().begin(), b.leaves().end(),
                    [](const Leaf& x, const Leaf& y) {
                      return x.box.min == y.box.min && x.box.max == y.box.max &&
                             x.first_test == y.first_test && x.test_count == y.test_count &&
                             x.kind == y.kind && x.solid == y.solid;
                    }) &&
         std::equal(a.tests().begin(), a.tests().end(), b.tests().begin(), b.tests().end());
}

class SubdivisionBudget : public testing::TestWithParam<std::tuple<Family, uint32_t, double>> {};

TEST_P(SubdivisionBudget, Holds) {
  const auto& [family, leaf_primitives, threshold_px] = GetParam();
  const Scene scene = family.make();
  const Solid solid(canonical_primitives(scene), scene.model);
  SubdivisionOptions options = options_of(solid, leaf_primitives, threshold_px);
  options.budget_bytes = 1 << 18;
  const Subdivision one(solid, options);
  EXPECT_GT(given_up(one), 0u);
  EXPECT_LE(one.bytes(), options.budget_bytes);
  EXPECT_GT(one.bytes(), options.budget_bytes / 16);  // the rest is for time
  EXPECT_EQ(census(one).leaves(), one.leaves().size());
  checks::expect_correct(one, scene, 1);
  options.threads = 2;
  EXPECT_TRUE(same_cells(one, Subdivision(solid, options)));
}

const Family kFamilies[] = {{"Vase", vase},
                            {"CubesOnAFace", cubes_on_a_face},
                            {"Plates", plates},
                            {"BarsAboutAnAxis", bars_about_an_axis},
                            {"NestedCylinders", nested_cylinders},
                            {"BallsThroughACircle", balls_through_a_circle},
                            {"ConesFromAPoint", cones_from_a_point},
                            {"Lattice", lattice}};

INSTANTIATE_TEST_SUITE_P(All, SubdivisionBudget,
                         testing::Combine(testing::ValuesIn(kFamilies), testing::Values(1, 2, 3),
                                          testing::Values(0.5, 1.0)),
                         [](const auto& param_info) {
                           return std::get<0>(param_info.param).name +
                                  ("K" + std::to_string(std::get<1>(param_info.param))) +
                                  (std::get<2>(param_info.param) < 1 ? "HalfAPixel" : "APixel");
                         });

/// Without a threshold no cell is dropped, so that the picture equals the tiles', bit for bit.
TEST(SubdivisionBudget, PicturesAreTheTiles) {
  for (const Family& family : kFamilies) {
    SCOPED_TRACE(family.name);
    const Scene scene = family.make();
    const Solid solid(canonical_primitives(scene), scene.model);
    SubdivisionOptions options = options_of(solid, 2, 1);
    options.threshold_px = 0;
    View view = *options.view;
    view.width_px = 160;
    view.height_px = 120;
    const Hits expected = checks::trace_by_tiles(solid, view);
    EXPECT_GT(checks::count_hits(expected), 1000u);
    for (const uint64_t budget : {uint64_t{0}, uint64_t{1} << 14, uint64_t{1} << 16}) {
      options.budget_bytes = budget == 0 ? 1 : budget;
      const Subdivision subdivision(solid, options);
      ASSERT_GT(given_up(subdivision), 0u);
      EXPECT_EQ(given_up(subdivision) == 1, budget == 0);
      EXPECT_TRUE(checks::same_bits(checks::trace_by_cells(subdivision, view), expected));
    }
  }
}

/// Cells that wait, round after round, for the credit of others end as they would have without a
/// budget.
TEST(SubdivisionBudget, WhatSufficesChangesNothing) {
  for (const Scene& scene :
       {test_support::cylinder_minus_spheres(200), test_support::cylinder_minus_cones(300),
        test_support::random_tree(40, 2), test_support::stacked_frusta(10)}) {
    const Solid solid(canonical_primitives(scene), scene.model);
    for (const uint32_t leaf_primitives : {1, 2}) {
      SubdivisionOptions options = options_of(solid, leaf_primitives, 16);
      options.budget_bytes = uint64_t{1} << 40;
      const Subdivision expected(solid, options);
      ASSERT_EQ(given_up(expected), 0u);
      uint64_t least = 0;  // a budget that just suffices
      for (uint64_t budget = expected.bytes(); least == 0; budget += budget / 2) {
        options.budget_bytes = budget;
        const Subdivision subdivision(solid, options);
        if (given_up(subdivision) > 0) continue;
        least = budget;
        EXPECT_TRUE(same_cells(subdivision, expected));
      }
      EXPECT_LT(least, 16 * expected.bytes());
      options.threads = 2;
      options.budget_bytes = least;
      uint64_t delivered = 0;
      const Subdivision by_tasks(solid, options, [&](const LeafBatch& batch) {
        for (const Leaf& leaf : batch.leaves) delivered += leaf.kind != LeafKind::kReplaced;
      });
      EXPECT_TRUE(same_cells(by_tasks, expected));
      EXPECT_EQ(delivered, expected.leaves().size());
    }
  }
}

TEST(SubdivisionBudget, DeliversWhatIsGivenUp) {
  const Scene scene = vase();
  const Solid solid(canonical_primitives(scene), scene.model);
  SubdivisionOptions options = options_of(solid, 2, 1);
  options.budget_bytes = 1 << 18;
  uint64_t delivered = 0, delivered_given_up = 0;
  const Subdivision subdivision(solid, options, [&](const LeafBatch& batch) {
    for (const Leaf& leaf : batch.leaves) {
      delivered += leaf.kind != LeafKind::kReplaced;
      delivered_given_up += leaf.kind == LeafKind::kGivenUp;
      ASSERT_LE(leaf.first_test + leaf.test_count, batch.tests.size());
    }
  });
  EXPECT_EQ(delivered, subdivision.leaves().size());
  EXPECT_EQ(delivered_given_up, given_up(subdivision));
}

/// Cells that the eye comes close to are divided further, until the budget is used up; then they
/// are drawn as they are.
TEST(SubdivisionBudget, HoldsForAllViewsTogether) {
  const Scene scene = vase();
  const Solid solid(canonical_primitives(scene), scene.model);
  SubdivisionOptions options = options_of(solid, 2, 40);
  options.budget_bytes = 1 << 22;
  Subdivision subdivision(solid, options);
  ASSERT_EQ(given_up(subdivision), 0u);
  for (const double distance : {1.5, 0.8, 0.4, 0.2, 0.1}) {
    const View view =
        checks::view_of(solid.bounds(), {0.48, 0.64, -0.6}, distance * solid.bounds().diagonal());
    EXPECT_TRUE(subdivision.refine(view));
    EXPECT_FALSE(subdivision.refine(view));
    EXPECT_LE(subdivision.bytes(), options.budget_bytes);
    for (const Leaf& leaf : subdivision.leaves()) {
      if (leaf.kind == LeafKind::kDropped) {
        ASSERT_LT(projected_size_px(view, leaf.box), options.threshold_px);
      }
    }
    checks::expect_correct(subdivision, scene, 1);
  }
  EXPECT_GT(given_up(subdivision), 0u);
}

/// The budget of a design that sets none.
TEST(SubdivisionBudget, IsInProportionToTheScene) {
  EXPECT_EQ(subdivision_budget(0), uint64_t{64} << 20);
  EXPECT_EQ(subdivision_budget(1000) - subdivision_budget(0), 1000u * 8192);
  EXPECT_EQ(subdivision_budget(size_t{1} << 40), uint64_t{2} << 30);
  const Scene scene = test_support::stacked_frusta(100);
  const Solid solid(canonical_primitives(scene), scene.model);
  SubdivisionOptions options = options_of(solid, 2, 1);
  options.threads = 0;
  const Subdivision subdivision(solid, options);
  EXPECT_GT(given_up(subdivision), 0u);
  EXPECT_LE(subdivision.bytes(), subdivision_budget(200));
}

}  // namespace
}  // namespace csgcore
