#include "csgcore/primitive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "checks.hpp"
#include "csgcore/canonical_primitive.hpp"

namespace csgcore {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Primitive, IsValid) {
  EXPECT_TRUE(is_valid(make_sphere(1)));
  for (const double radius : {0.0, -1.0, kInfinity, kNan}) {
    EXPECT_FALSE(is_valid(make_sphere(radius))) << radius;
  }
  EXPECT_TRUE(is_valid(make_frustum(0, 1, 1, 1)));
  EXPECT_TRUE(is_valid(make_frustum(0, 1, 0, 1)));
  EXPECT_TRUE(is_valid(make_frustum(0, 1, 1, 0)));
  EXPECT_FALSE(is_valid(make_frustum(0, 1, 0, 0)));
  EXPECT_FALSE(is_valid(make_frustum(0, 1, -1, 2)));
  EXPECT_FALSE(is_valid(make_frustum(0, 1, 2, -1)));
  EXPECT_FALSE(is_valid(make_frustum(0, 1, kInfinity, 1)));
  EXPECT_FALSE(is_valid(make_frustum(0, 1, 1, kNan)));
  EXPECT_FALSE(is_valid(make_frustum(0, 0, 1, 1)));
  EXPECT_FALSE(is_valid(make_frustum(1, 0, 1, 1)));
  EXPECT_FALSE(is_valid(make_frustum(0, kInfinity, 1, 1)));
  EXPECT_FALSE(is_valid(make_frustum(0, kNan, 1, 1)));
}

TEST(Primitive, IsValidUnderMatrices) {
  Affine map;
  EXPECT_TRUE(is_valid(make_sphere(1, map)));
  map.linear[0][0] = -1;  // a mirror
  EXPECT_TRUE(is_valid(make_sphere(1, map)));
  map.linear[0][0] = 0;  // flattens the primitive
  EXPECT_FALSE(is_valid(make_sphere(1, map)));
  map.linear[0][0] = kNan;
  EXPECT_FALSE(is_valid(make_sphere(1, map)));
  map.linear[0][0] = 1;
  map.translation.y = kInfinity;
  EXPECT_FALSE(is_valid(make_sphere(1, map)));
  map.translation.y = 1e12;
  map.linear = Mat3{1e-9};
  EXPECT_TRUE(is_valid(make_sphere(1, map)));
  map.linear = Mat3{1e-200};  // its determinant underflows
  EXPECT_FALSE(is_valid(make_sphere(1, map)));
}

class CanonicalPrimitiveOf : public testing::TestWithParam<test_support::Variant> {
 protected:
  Primitive make(std::mt19937& random) const {
    test_support::Sizes sizes(random);
    Primitive primitive = GetParam().make(sizes);
    primitive.local_to_world = test_support::random_affine(random);
    return primitive;
  }
  /// Answers about solids that are not convex are by brute force: fewer of them are asked for.
  int rounds(int of_convex) const {
    std::mt19937 random(1);
    const bool is_convex = csgcore::is_convex(make(random).shape());
    return is_convex ? of_convex : of_convex / 5;
  }
};

INSTANTIATE_TEST_SUITE_P(, CanonicalPrimitiveOf, testing::ValuesIn(test_support::all_variants()),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(CanonicalPrimitiveOf, BoundsAreTightAndHoldEverything) {
  std::mt19937 random(1);
  const int count = rounds(20);
  for (int round = 0; round < count; ++round) {
    const Primitive primitive = make(random);
    const CanonicalPrimitive canonical = canonicalize(primitive);
    const Extent extent = extent_of(canonical);
    Box sampled;
    for (int i = 0; i < 20000; ++i) sampled.merge(checks::surface_point(primitive, random));
    const double size = canonical.bounds.diagonal();
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_GE(sampled.min[axis], canonical.bounds.min[axis] - 1e-14 * size);
      ASSERT_LE(sampled.max[axis], canonical.bounds.max[axis] + 1e-14 * size);
      ASSERT_NEAR(sampled.min[axis], canonical.bounds.min[axis], 0.01 * size);
      ASSERT_NEAR(sampled.max[axis], canonical.bounds.max[axis], 0.01 * size);
      ASSERT_LE(extent.center[axis] - extent.half[axis], sampled.min[axis]);
      ASSERT_GE(extent.center[axis] + extent.half[axis], sampled.max[axis]);
      ASSERT_NEAR(2 * extent.half[axis], canonical.bounds.size()[axis], 1e-11 * size);
    }
  }
}

TEST_P(CanonicalPrimitiveOf, ContainsWhatThePrimitiveDoes) {
  std::mt19937 random(2);
  int inside = 0;
  const int count = rounds(50);
  for (int round = 0; round < count; ++round) {
    const Primitive primitive = make(random);
    const CanonicalPrimitive canonical = canonicalize(primitive);
    for (int i = 0; i < 300; ++i) {
      const Vec3 point = checks::random_point(random, canonical.bounds);
      ASSERT_EQ(contains(canonical, point), checks::holds(primitive, point));
      inside += contains(canonical, point);
    }
    // Just within and just beyond the surface.
    const Vec3 surface = checks::surface_point(primitive, random);
    const Vec3 core = test_support::core_of(primitive, surface);
    ASSERT_TRUE(contains(canonical, glm::mix(core, surface, 1 - 1e-9)));
    ASSERT_FALSE(contains(canonical, glm::mix(core, surface, 1 + 1e-9)));
  }
  EXPECT_GT(inside, count == 50 ? 1000 : 50);
}

TEST(CanonicalPrimitive, KnowsBalls) {
  std::mt19937 random(3);
  const Affine turned{Mat3{0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1}, {1, 2, 3}};
  EXPECT_DOUBLE_EQ(canonicalize(make_sphere(2, turned)).ball_radius, 2);
  Affine mirrored = turned;
  mirrored.linear[2][2] = -1;
  EXPECT_DOUBLE_EQ(canonicalize(make_sphere(2, mirrored)).ball_radius, 2);
  Affine scaled = turned;
  scaled.linear[2][2] = 1 + 1e-9;
  EXPECT_EQ(canonicalize(make_sphere(2, scaled)).ball_radius, 0);
  EXPECT_EQ(canonicalize(make_frustum(0, 1, 1, 1)).ball_radius, 0);
}

TEST(CanonicalPrimitive, KeepsColourAndId) {
  Primitive primitive = make_sphere(1);
  primitive.id = 17;
  primitive.color = Color{0.1f, 0.2f, 0.3f, 0.4f};
  const CanonicalPrimitive canonical = canonicalize(primitive);
  EXPECT_EQ(canonical.id, 17u);
  EXPECT_EQ(canonical.color, primitive.color);
}

}  // namespace
}  // namespace csgcore
