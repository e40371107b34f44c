// Tests the boxes of what operations leave, against points of the solids and against solids whose
// box is known.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "checks.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/solid.hpp"
#include "support/models.hpp"

namespace csgcore {
namespace {

constexpr uint64_t kPlenty = 1 << 20;
constexpr double kExact = 1e-11;

Primitive box_of(const Vec3& min, const Vec3& max, const Affine& place = {}) {
  return make_polyhedron(Polyhedron::box({min, max}), place);
}

Affine turned_about_z(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {Mat3(Vec3(c, s, 0), Vec3(-s, c, 0), Vec3(0, 0, 1)), Vec3(0.0)};
}

Box bounds_of(Op op, const std::vector<Primitive>& primitives, uint64_t tests = kPlenty) {
  std::vector<CanonicalPrimitive> canonical;
  CsgTreeBuilder builder;
  builder.open(op);
  for (const Primitive& primitive : primitives) {
    builder.primitive(static_cast<uint32_t>(canonical.size()));
    canonical.push_back(canonicalize(primitive));
  }
  builder.close();
  BoundsBudget budget{tests};
  return tight_bounds(canonical, builder.finish(), budget);
}

/// Takes the difference of the first primitive and the others.
Box bounds_of_difference(const std::vector<Primitive>& primitives, uint64_t tests = kPlenty) {
  return bounds_of(Op::kDifference, primitives, tests);
}

void expect_box(const Box& box, const Vec3& min, const Vec3& max, double accuracy) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.min[axis], min[axis], accuracy) << axis;
    EXPECT_NEAR(box.max[axis], max[axis], accuracy) << axis;
  }
}

class TightBoundsOf : public testing::TestWithParam<uint64_t> {};

TEST_P(TightBoundsOf, RandomTreesHoldAllTheirPoints) {
  constexpr uint32_t kTrees = 100;
  constexpr int kPoints = 500;
  std::mt19937 random(1);
  for (uint32_t seed = 1; seed <= kTrees; ++seed) {
    const Scene scene = test_support::random_tree_of_all_kinds(2 + seed % 9, seed);
    const Solid solid(canonical_primitives(scene), scene.model);
    BoundsBudget budget{GetParam()};
    const Box box = tight_bounds(solid.primitives(), scene.model, budget);
    EXPECT_LE(budget.tests, GetParam());
    if (solid.bounds().empty()) continue;
    for (int i = 0; i < kPoints; ++i) {
      const Vec3 point = checks::random_point(random, solid.bounds());
      if (!solid.contains(point)) continue;
      EXPECT_FALSE(intersection(box, {point, point}).empty())
          << seed << ": " << point.x << ' ' << point.y << ' ' << point.z;
    }
  }
}

// Whatever the budget is, no side is too near.
INSTANTIATE_TEST_SUITE_P(Budgets, TightBoundsOf, testing::Values(0, 1, 20, 300, kPlenty));

TEST(TightBounds, AreThoseOfTheOperandsWithoutABudget) {
  const std::vector<Primitive> cut{box_of(Vec3(0), Vec3(10)), box_of(Vec3(-1, -1, 4), Vec3(11))};
  expect_box(bounds_of_difference(cut, 0), Vec3(0), Vec3(10), 0);
  expect_box(bounds_of_difference(cut), Vec3(0), Vec3(10, 10, 4), kExact);
}

// A pin far thinner than any pixel.
TEST(TightBounds, HoldThinParts) {
  const double thickness = 1e-6;
  std::vector<CanonicalPrimitive> primitives{
      canonicalize(box_of(Vec3(-5), Vec3(5))),
      canonicalize(make_frustum(-50, 50, thickness, thickness, {Mat3(1.0), Vec3(1.23, 2.34, 0)})),
      canonicalize(box_of(Vec3(-5, -5, 45), Vec3(5, 5, 55)))};
  CsgTreeBuilder builder;
  builder.open(Op::kDifference);
  builder.open(Op::kUnion);
  builder.primitive(0);
  builder.primitive(1);
  builder.close();
  builder.primitive(2);
  builder.close();
  BoundsBudget budget{kPlenty};
  expect_box(tight_bounds(primitives, builder.finish(), budget), Vec3(-5, -5, -50), Vec3(5, 5, 45),
             1e-9);
}

// No cell on a joint lies in either of two flush operands.
TEST(TightBounds, PassJointsOfFlushOperands) {
  const Box box = bounds_of_difference(
      {box_of(Vec3(0), Vec3(10)), box_of(Vec3(-1, -1, 4), Vec3(3.3, 11, 11)),
       box_of(Vec3(3.3, -1, 4), Vec3(11, 7.7, 11)), box_of(Vec3(3.3, 7.7, 4), Vec3(11, 11, 11))});
  expect_box(box, Vec3(0), Vec3(10, 10, 4), kExact);
}

TEST(TightBounds, AreEmptyIfNothingIsLeft) {
  EXPECT_TRUE(bounds_of_difference({box_of(Vec3(0), Vec3(5)), box_of(Vec3(0), Vec3(5))}).empty());
  const Primitive turned = box_of(Vec3(0), Vec3(5), turned_about_z(0.5));
  EXPECT_FALSE(bounds_of_difference({box_of(Vec3(0), Vec3(5)), turned}).empty());
  BoundsBudget budget{kPlenty};
  EXPECT_TRUE(tight_bounds({}, CsgTree(), budget).empty());
}

// Neither do joints that lie across all axes, where no division runs along them.
TEST(TightBounds, PassJointsOfOperandsThatAreTurned) {
  const Affine turned = turned_about_z(0.3);
  const Box box = bounds_of_difference({box_of(Vec3(-5), Vec3(5)),
                                        box_of(Vec3(-9, -9, 1), Vec3(0.5, 9, 9), turned),
                                        box_of(Vec3(0.5, -9, 1), Vec3(9, 9, 9), turned)});
  expect_box(box, Vec3(-5), Vec3(5, 5, 1), 1e-7);
}

// The edges where turned sides meet are found by half-spaces, without dividing down to them.
TEST(TightBounds, EndAtEdgesOfWhatIsTurned) {
  const double angle = 0.3;
  const std::vector<Primitive> bars{
      box_of(Vec3(-9, -1, -1), Vec3(9, 1, 1), turned_about_z(angle)),
      box_of(Vec3(-9, -1, -1), Vec3(9, 1, 1), turned_about_z(-angle))};
  const Vec3 rhombus(1 / std::sin(angle), 1 / std::cos(angle), 1);
  expect_box(bounds_of(Op::kIntersection, bars), -rhombus, rhombus, 1e-7);
}

// What is left is a thousandth of the operands, and the accuracy is a share of it.
TEST(TightBounds, AreTightAboutWhatIsSmall) {
  const Box box = bounds_of_difference(
      {box_of(Vec3(0), Vec3(1000)), box_of(Vec3(-1), Vec3(999, 1001, 1001)),
       box_of(Vec3(-1), Vec3(1001, 998, 1001)), box_of(Vec3(-1), Vec3(1001, 1001, 999.5)),
       make_sphere(0.25, {Mat3(1.0), Vec3(1000)})});
  expect_box(box, Vec3(999, 998, 999.5), Vec3(1000), 1e-3);
}

// The highest points are a circle: that takes far more cells than a point.
TEST(TightBounds, EndWithTheBudgetWhereSurfacesMeetAlongACurve) {
  const std::vector<Primitive> bead{make_sphere(25), make_frustum(-30, 30, 12, 12)};
  const double rim = std::sqrt(25.0 * 25 - 12 * 12);
  double before = 25;
  for (const uint64_t tests : {5000, 100000}) {
    const Box box = bounds_of_difference(bead, tests);
    EXPECT_GE(box.max.z, rim);
    EXPECT_LT(box.max.z, before);
    before = box.max.z;
  }
  EXPECT_LT(before, rim + 0.02);
}

}  // namespace
}  // namespace csgcore
