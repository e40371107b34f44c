#include "checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "support/evaluate_tree.hpp"
#include "support/models.hpp"

namespace csgcore::checks {

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 random_point(std::mt19937& random, const Box& box) {
  return {uniform(random, box.min.x, box.max.x), uniform(random, box.min.y, box.max.y),
          uniform(random, box.min.z, box.max.z)};
}

Primitive random_primitive(std::mt19937& random, const test_support::SizeRange& range) {
  Affine map = test_support::random_affine(random);
  if (random() % 4 == 0) map.linear = Mat3{uniform(random, 0.5, 1.5)};
  test_support::Sizes sizes(random, range);
  return test_support::random_primitive(sizes, map);
}

bool holds(const Scene& scene, const Vec3& point) {
  return test_support::evaluate_tree(scene.model.tokens(),
                                     [&](uint32_t i) { return holds(scene.primitives[i], point); });
}

bool holds(const Subdivision& subdivision, const Leaf& leaf, const Vec3& point) {
  if (leaf.test_count == 0) return leaf.solid;
  return evaluate(subdivision.tests_of(leaf), [&](uint32_t primitive) {
    return contains(subdivision.solid().primitives()[primitive], point);
  });
}

std::set<uint32_t> named_by(const Solid& solid) {
  std::set<uint32_t> primitives;
  for (const BlistTest& test : solid.list().tests) primitives.insert(test.primitive);
  return primitives;
}

View view_of(const Box& box, const Vec3& direction, double distance) {
  View view;
  view.forward = direction;
  const Vec3 helper = std::abs(direction.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
  view.right = glm::normalize(glm::cross(direction, helper));
  view.up = glm::cross(view.right, direction);
  view.eye = box.center() - distance * direction;
  view.half_height = 0.2;
  view.width_px = 640;
  view.height_px = 480;
  return view;
}

namespace {

void expect_kind(const Subdivision& subdivision, const Leaf& leaf) {
  const SubdivisionOptions& options = subdivision.options();
  const auto tests = subdivision.tests_of(leaf);
  std::set<uint32_t> distinct;
  for (const BlistTest& test : tests) distinct.insert(test.primitive);
  const bool few = distinct.size() <= options.leaf_primitives;
  if (leaf.kind != LeafKind::kEmpty) {
    EXPECT_FALSE(leaf.solid);
  }
  switch (leaf.kind) {
    case LeafKind::kEmpty:
      EXPECT_EQ(leaf.test_count, 0u);
      break;
    case LeafKind::kUnion:
      EXPECT_TRUE(is_union(tests));
      EXPECT_TRUE(few || options.stop_at_unions);
      break;
    case LeafKind::kPair:
      EXPECT_EQ(tests.size(), 2u);
      EXPECT_FALSE(is_union(tests));
      EXPECT_TRUE(few);
      break;
    case LeafKind::kGeneral:
      EXPECT_NE(tests.size(), 2u);
      EXPECT_FALSE(is_union(tests));
      EXPECT_TRUE(few);
      break;
    case LeafKind::kFull:
    case LeafKind::kGivenUp:
      EXPECT_FALSE(few);
      break;
    case LeafKind::kDropped:
      EXPECT_FALSE(few);
      EXPECT_LT(projected_size_px(*options.view, leaf.box), options.threshold_px);
      break;
    case LeafKind::kReplaced:
      break;
  }
}

double volume(const Box& box) {
  const Vec3 size = box.size();
  return size.x * size.y * size.z;
}

}  // namespace

void expect_correct(const Subdivision& subdivision, const Scene& scene, int points_per_leaf) {
  std::mt19937 random(7);
  double sum = 0;
  size_t wrong = 0;
  for (const Leaf& leaf : subdivision.leaves()) {
    expect_kind(subdivision, leaf);
    if (leaf.kind == LeafKind::kReplaced) continue;
    sum += volume(leaf.box);
    for (int i = 0; i < points_per_leaf; ++i) {
      const Vec3 point = random_point(random, leaf.box);
      wrong += holds(subdivision, leaf, point) != holds(scene, point);
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(wrong, 0u) << "of " << subdivision.leaves().size() << " leaves";
  if (subdivision.nodes().empty()) return;
  EXPECT_NEAR(sum / volume(subdivision.root_box()), 1, 1e-9);
  // The tree leads to the leaves' cells.
  for (int i = 0; i < 1000; ++i) {
    const Vec3 point = random_point(random, subdivision.root_box());
    const Leaf* leaf = subdivision.find(point);
    ASSERT_NE(leaf, nullptr);
    ASSERT_NE(leaf->kind, LeafKind::kReplaced);
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_GE(point[axis], leaf->box.min[axis]);
      ASSERT_LE(point[axis], leaf->box.max[axis]);
    }
  }
}

}  // namespace csgcore::checks
