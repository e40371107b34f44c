#include "solid/restriction.hpp"

#include <gtest/gtest.h>

#include "checks.hpp"
#include "support/full_run.hpp"
#include "support/models.hpp"

namespace csgcore {
namespace {

std::vector<BlistTest> tests_of(const CellList& list) {
  std::vector<BlistTest> tests;
  append(tests, list);
  return tests;
}

bool value_at(const Solid& solid, const CellList& list, const Vec3& point) {
  if (list.is_constant()) return list.root == CellList::kTrue;
  return evaluate(std::span<const BlistTest>(tests_of(list)), [&](uint32_t primitive) {
    return contains(solid.primitives()[primitive], point);
  });
}

/// Fails unless nothing in the list is decided, irrelevant or out of reach.
void expect_irreducible(const Solid& solid, const CellList& list, const Box& cell, bool all_cross) {
  const std::vector<BlistTest> tests = tests_of(list);
  std::vector<bool> reached(tests.size());
  if (!tests.empty()) reached[0] = true;
  for (size_t i = 0; i < tests.size(); ++i) {
    ASSERT_TRUE(reached[i]);
    ASSERT_NE(tests[i].if_inside, tests[i].if_outside);
    for (const uint32_t target : {tests[i].if_inside, tests[i].if_outside}) {
      ASSERT_GT(target, i);
      if (target < kListFalse) reached.at(target) = true;
    }
    if (!all_cross) continue;
    ASSERT_EQ(classify(solid.primitives()[tests[i].primitive], cell), Classification::kCrosses);
  }
}

Box random_cell(std::mt19937& random, const Box& bounds) {
  const Vec3 center = checks::random_point(random, bounds);
  const Vec3 half = bounds.size() * checks::random_point(random, {Vec3(0.02), Vec3(0.3)});
  return {center - half, center + half};
}

class RestrictionOf : public testing::TestWithParam<uint32_t> {};

TEST_P(RestrictionOf, RandomTreeEqualsTheListWithinTheCell) {
  const Scene scene = test_support::random_tree_of_all_kinds(GetParam(), GetParam());
  const Solid solid(canonical_primitives(scene), scene.model);
  if (solid.list().tests.empty()) GTEST_SKIP() << "an empty tree";
  const WorldClassifier classifier(solid.primitives());
  Restrictor restrictor(solid.extents(), classifier);
  CellList whole, in_cell, below, above;
  assign(whole, solid.list().tests);
  std::mt19937 random(1);
  for (uint32_t round = 0; round < test_support::sample_size(60); ++round) {
    const Box cell = random_cell(random, {Vec3(-8.0), Vec3(8.0)});
    restrictor.restrict(whole, cell, in_cell);
    expect_irreducible(solid, in_cell, cell, true);
    for (int i = 0; i < 100; ++i) {
      const Vec3 point = checks::random_point(random, cell);
      ASSERT_EQ(value_at(solid, in_cell, point), checks::holds(scene, point));
    }
    if (in_cell.is_constant()) continue;
    Halves halves{cell, cell, static_cast<uint32_t>(random() % 3)};
    const int axis = static_cast<int>(halves.axis);
    halves.below.max[axis] = halves.above.min[axis] =
        checks::uniform(random, cell.min[axis], cell.max[axis]);
    restrictor.restrict(in_cell, halves, below, above);
    for (const bool side : {false, true}) {
      const Box& half = side ? halves.above : halves.below;
      const CellList& list = side ? above : below;
      expect_irreducible(solid, list, half, false);
      for (int i = 0; i < 50; ++i) {
        const Vec3 point = checks::random_point(random, half);
        ASSERT_EQ(value_at(solid, list, point), checks::holds(scene, point));
      }
    }
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, RestrictionOf,
                         testing::Values(1, 2, 3, 5, 8, 13, 30, 63, 64, 65, 130, 400));

TEST(CellList, KeepsAListBothWays) {
  const Scene scene = test_support::random_tree(50, 4);
  const Blist list = compile(scene.model);
  CellList cell_list;
  assign(cell_list, list.tests);
  EXPECT_EQ(tests_of(cell_list), list.tests);
  EXPECT_EQ(is_union(cell_list), is_union(list.tests));
  assign(cell_list,
         compile(checks::scene_of(Op::kUnion, {make_sphere(1), make_sphere(2)}).model).tests);
  EXPECT_TRUE(is_union(cell_list));
  EXPECT_EQ(cell_list.count(), 2u);
}

/// In a cell far from an operand, nothing below it is visited: the operand is dropped as a whole.
TEST(Restriction, DropsWhatAnOperandMadeIrrelevant) {
  Scene scene;
  CsgTreeBuilder builder;
  for (uint32_t part = 0; part < 2; ++part) {
    builder.open(Op::kDifference);
    for (uint32_t i = 0; i < 4; ++i) {
      const Vec3 center{10.0 * part, i, 0.0};
      scene.primitives.push_back(make_sphere(i == 0 ? 1.0 : 20.0, {Mat3{1.0}, center}));
      builder.primitive(4 * part + i);
    }
    builder.close();
  }
  scene.model = builder.finish();
  const Solid solid(canonical_primitives(scene), scene.model);
  const WorldClassifier classifier(solid.primitives());
  Restrictor restrictor(solid.extents(), classifier);
  CellList whole, list;
  assign(whole, solid.list().tests);
  ASSERT_EQ(whole.count(), 8u);
  // Both parts' cutting spheres cross the cell, but only the second part's body does.
  restrictor.restrict(whole, {{9, -30, -2}, {12, 30, 2}}, list);
  EXPECT_EQ(list.count(), 4u);
  for (const uint32_t primitive : list.primitives()) EXPECT_GE(primitive & kPrimitiveBits, 4u);
}

}  // namespace
}  // namespace csgcore
