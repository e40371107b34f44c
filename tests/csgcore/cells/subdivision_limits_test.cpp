// Tests scenes for which subdivision would never end, or has nothing to do.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "checks.hpp"
#include "csgcore/subdivision.hpp"
#include "support/models.hpp"

namespace csgcore {
namespace {

const double kTurn = 2 * std::acos(-1.0);

Primitive sphere_at(const Vec3& center, double radius) {
  return make_sphere(radius, {Mat3{1.0}, center});
}

/// A scene whose subdivision must end, keep its meaning and stay of sensible size.
struct Limit {
  const char* name;
  Scene (*make)();
  uint32_t leaf_primitives;
  size_t most_leaves;
  size_t most_tests;
};

Scene coincident_spheres() {
  return checks::scene_of(Op::kUnion, std::vector<Primitive>(1000, make_sphere(1)));
}

Scene coincident_intersection() {
  return checks::scene_of(Op::kIntersection, std::vector<Primitive>(1000, make_sphere(1)));
}

/// 100 spheres whose surfaces all contain the origin.
Scene spheres_through_a_point() {
  std::mt19937 random(1);
  std::vector<Primitive> spheres;
  for (int i = 0; i < 100; ++i) {
    const double radius = checks::uniform(random, 0.5, 2);
    spheres.push_back(sphere_at(radius * checks::random_direction(random), radius));
  }
  return checks::scene_of(Op::kUnion, spheres);
}

/// A ball minus 100 cylinders whose walls all contain the z axis.
Scene walls_through_a_line() {
  std::vector<Primitive> primitives{make_sphere(3)};
  for (int i = 0; i < 100; ++i) {
    const double angle = kTurn * i / 100;
    const Affine map{Mat3{1.0}, 0.5 * Vec3(std::cos(angle), std::sin(angle), 0)};
    primitives.push_back(make_frustum(-5, 5, 0.5, 0.5, map));
  }
  return checks::scene_of(Op::kDifference, primitives);
}

/// 100 spheres of different sizes whose surfaces all contain the unit circle about z.
Scene spheres_through_a_circle() {
  std::vector<Primitive> spheres;
  for (int i = 0; i < 100; ++i) {
    const double height = (i - 49.5) / 30;
    spheres.push_back(sphere_at({0, 0, height}, std::sqrt(1 + height * height)));
  }
  return checks::scene_of(Op::kIntersection, spheres);
}

/// 1,000 nested spheres. Each division halves the gaps but doubles the cells along them: with at
/// most 8 a cell, separating them would take millions of cells.
Scene shells_that_slowly_separate() {
  std::vector<Primitive> primitives{make_frustum(-15, 15, 12, 12)};
  for (int i = 0; i < 1000; ++i) primitives.push_back(make_sphere(10 - 1e-3 * i));
  return checks::scene_of(Op::kDifference, primitives);
}

/// 100 nested shells, 1e-6 apart.
Scene nested_shells() {
  Scene scene;
  CsgTreeBuilder builder;
  for (uint32_t i = 0; i < 100; ++i) {
    builder.open(Op::kDifference);
    scene.primitives.push_back(make_sphere(1 - 2e-6 * i));
    scene.primitives.push_back(make_sphere(1 - 2e-6 * i - 1e-6));
    builder.primitive(2 * i);
    builder.primitive(2 * i + 1);
    builder.close();
  }
  scene.model = builder.finish();
  return scene;
}

/// A row of 50 spheres, each touching the next in a point.
Scene tangent_spheres() {
  std::vector<Primitive> spheres;
  for (int i = 0; i < 50; ++i) spheres.push_back(sphere_at({2.0 * i, 0, 0}, 1));
  return checks::scene_of(Op::kUnion, spheres);
}

/// A needle across a plate that is thinner still.
Scene needle_and_plate() {
  const Affine tilt{Mat3{0.8, 0, 0.6, 0, 1, 0, -0.6, 0, 0.8}, Vec3{0.0}};
  return checks::scene_of(
      Op::kUnion, {make_frustum(-1000, 1000, 1e-3, 1e-3, tilt), make_frustum(0, 1e-5, 100, 100),
                   make_frustum(0, 1e-4, 0, 100, tilt)});
}

Scene far_and_small() {
  std::vector<Primitive> spheres;
  for (int i = 0; i < 20; ++i) {
    spheres.push_back(sphere_at({1e12 + i, -1e12, 1e12}, i % 2 == 0 ? 1e-9 : 1.0));
  }
  return checks::scene_of(Op::kUnion, spheres);
}

Scene tiny() {
  Scene scene = test_support::cylinder_minus_spheres(50);
  for (Primitive& primitive : scene.primitives) {
    const Affine shrink{Mat3{1e-9}, Vec3{0.0}};
    primitive.local_to_world = compose(shrink, primitive.local_to_world);
  }
  return scene;
}

Scene many_scales() {
  std::vector<Primitive> spheres;
  for (int i = 0; i < 60; ++i) {
    const double size = std::pow(0.7, i);
    spheres.push_back(sphere_at({size, 0, 0}, 0.9 * size));
  }
  return checks::scene_of(Op::kUnion, spheres);
}

class SubdivisionLimits : public testing::TestWithParam<std::tuple<Limit, SplitRule>> {};

TEST_P(SubdivisionLimits, EndsAndKeepsItsMeaning) {
  const auto& [limit, split] = GetParam();
  const Scene scene = limit.make();
  for (const Primitive& primitive : scene.primitives) ASSERT_TRUE(is_valid(primitive));
  const Solid solid(canonical_primitives(scene), scene.model);
  SubdivisionOptions options;
  options.leaf_primitives = limit.leaf_primitives;
  options.split = split;
  options.threads = 1;
  const Subdivision subdivision(solid, options);
  checks::expect_correct(subdivision, scene, 1);
  EXPECT_GE(subdivision.leaves().size(), 1u);
  EXPECT_LE(subdivision.leaves().size(), limit.most_leaves);
  EXPECT_LE(subdivision.tests().size(), limit.most_tests);
  RecordProperty("leaves", static_cast<int>(subdivision.leaves().size()));
  RecordProperty("tests", static_cast<int>(subdivision.tests().size()));
}

const Limit kLimits[] = {
    {"CoincidentSpheres", coincident_spheres, 8, 600, 400000},
    {"CoincidentIntersection", coincident_intersection, 8, 600, 400000},
    {"SpheresThroughAPoint", spheres_through_a_point, 8, 500, 2000},
    {"WallsThroughALine", walls_through_a_line, 8, 60000, 200000},
    {"SpheresThroughACircle", spheres_through_a_circle, 8, 40000, 120000},
    {"NestedShells", nested_shells, 8, 600, 80000},
    {"ShellsThatSlowlySeparate", shells_that_slowly_separate, 8, 20000, 1200000},
    {"TangentSpheres", tangent_spheres, 2, 40000, 80000},
    {"NeedleAndPlate", needle_and_plate, 1, 1000, 1000},
    {"FarAndSmall", far_and_small, 2, 1000, 1600},
    {"Tiny", tiny, 2, 10000, 12000},
    {"ManyScales", many_scales, 8, 400, 2000},
};

INSTANTIATE_TEST_SUITE_P(All, SubdivisionLimits,
                         testing::Combine(testing::ValuesIn(kLimits),
                                          testing::Values(SplitRule::kCyclic,
                                                          SplitRule::kSurfaceArea)),
                         [](const auto& param_info) {
                           const bool cyclic = std::get<1>(param_info.param) == SplitRule::kCyclic;
                           return std::string(std::get<0>(param_info.param).name) +
                                  (cyclic ? "Cyclic" : "SurfaceArea");
                         });

TEST(SubdivisionLimit, OfTheEmptySolid) {
  const Scene scene;
  const Solid solid(canonical_primitives(scene), scene.model);
  const Subdivision subdivision(solid, {});
  EXPECT_TRUE(subdivision.nodes().empty());
  EXPECT_TRUE(subdivision.leaves().empty());
  EXPECT_EQ(subdivision.find({0, 0, 0}), nullptr);
  EXPECT_EQ(census(subdivision).leaves(), 0u);
}

TEST(SubdivisionLimit, OfAnIntersectionOfBoxesApart) {
  const Scene scene =
      checks::scene_of(Op::kIntersection, {make_sphere(1), sphere_at({3, 0, 0}, 1)});
  const Solid solid(canonical_primitives(scene), scene.model);
  EXPECT_TRUE(Subdivision(solid, {}).nodes().empty());
}

/// The root cell is entirely inside a cut: it is empty, though the tree is not.
TEST(SubdivisionLimit, OfABodyThatIsCutAway) {
  const Scene scene = checks::scene_of(Op::kDifference, {make_sphere(1), make_sphere(9)});
  const Solid solid(canonical_primitives(scene), scene.model);
  const Subdivision subdivision(solid, {});
  ASSERT_EQ(subdivision.leaves().size(), 1u);
  EXPECT_EQ(subdivision.leaves()[0].kind, LeafKind::kEmpty);
  EXPECT_FALSE(subdivision.leaves()[0].solid);
}

TEST(SubdivisionLimit, FullCellsAreSolid) {
  const Scene scene = test_support::cylinder_minus_spheres(500);
  const Solid solid(canonical_primitives(scene), scene.model);
  const Subdivision subdivision(solid, {});
  const Leaf* inner = subdivision.find({0, 0, 0});
  ASSERT_NE(inner, nullptr);
  EXPECT_EQ(inner->kind, LeafKind::kEmpty);
  EXPECT_TRUE(inner->solid);
}

/// Returns the number of leaves of one kind.
uint64_t leaves_of_kind(const Subdivision& subdivision, LeafKind kind) {
  return census(subdivision).by_kind[static_cast<size_t>(kind)];
}

TEST(SubdivisionLimits, ADensePartFarFromAnotherIsDivided) {
  Scene scene = test_support::cylinder_minus_spheres(500);
  CsgTreeBuilder tree;
  tree.open(Op::kUnion);
  tree.open(Op::kDifference);
  for (uint32_t i = 0; i <= 500; ++i) tree.primitive(i);
  tree.close();
  scene.primitives.push_back(sphere_at({1e4, 1e4, 0}, 1));
  tree.primitive(501);
  tree.close();
  scene.model = tree.finish();
  const Solid solid(canonical_primitives(scene), scene.model);
  const Subdivision subdivision(solid, {});
  EXPECT_GT(leaves_of_kind(subdivision, LeafKind::kGeneral), 100u);
  EXPECT_LT(leaves_of_kind(subdivision, LeafKind::kFull), 100u);
}

TEST(SubdivisionLimits, EndsWhereCoordinatesAreTooCoarse) {
  const Scene scene = checks::scene_of(
      Op::kIntersection,
      {sphere_at({1e12, 0, 0}, 1), sphere_at({1e12, 0.5, 0}, 1), sphere_at({1e12, 0, 0.5}, 1)});
  const Solid solid(canonical_primitives(scene), scene.model);
  View view;
  view.eye = {1e12, 0, 10};
  const Subdivision subdivision(solid, SubdivisionOptions::paper(1e-9, view));
  EXPECT_LT(subdivision.leaves().size(), 200000u);
}

/// Three plates share an upper face, all of which the paper's rule alone would drop.
TEST(SubdivisionLimits, CoincidentFacesAreNotDropped) {
  std::vector<Primitive> plates;
  for (const Vec3& center : {Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{1, 2, 0}}) {
    plates.push_back(make_frustum(0, 1, 5, 5, {Mat3{1.0}, center}));
  }
  const Scene scene = checks::scene_of(Op::kIntersection, plates);
  const Solid solid(canonical_primitives(scene), scene.model);
  View view;
  view.projection = Projection::kOrthographic;
  view.eye = {1, 1, 50};
  view.half_height = 10;
  view.width_px = view.height_px = 100;
  const Subdivision subdivision(solid, SubdivisionOptions::paper(1, view));
  const uint64_t kept = leaves_of_kind(subdivision, LeafKind::kFull);
  EXPECT_GT(kept, 4 * leaves_of_kind(subdivision, LeafKind::kDropped));
  // With the eye in the model, cells in front of it never become small.
  view.projection = Projection::kPerspective;
  view.eye = {1, 0.5, 0.999};
  const Subdivision close(solid, SubdivisionOptions::paper(1, view));
  EXPECT_LT(close.leaves().size(), 3000000u);
}

}  // namespace
}  // namespace csgcore
