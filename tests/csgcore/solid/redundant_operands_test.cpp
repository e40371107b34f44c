// Tests that operands that are there twice, or are inside others, are left out, and that the
// picture stays the same.
#include "solid/redundant_operands.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "checks.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/tracer.hpp"
#include "made.hpp"
#include "support/full_run.hpp"
#include "support/models.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

using checks::Made;
using checks::moved;
using checks::named_by;
using checks::tree_of;
using testing::ElementsAre;

/// "(- 0 1 (+ 2 3))".
std::string text_of(const CsgTree& tree) {
  std::vector<std::string> operands;
  for (const CsgToken& token : tree.tokens()) {
    if (token.is_primitive) {
      operands.push_back(std::to_string(token.value));
      continue;
    }
    const char* const name = token.op == Op::kUnion ? "+" : token.op == Op::kDifference ? "-" : "*";
    std::string text = std::string("(") + name;
    for (size_t i = operands.size() - token.value; i < operands.size(); ++i) {
      text += ' ' + operands[i];
    }
    operands.resize(operands.size() - token.value);
    operands.push_back(text + ')');
  }
  return operands.empty() ? "" : operands.back();
}

std::optional<CsgTree> lean_of(const Scene& scene) {
  const auto primitives = canonical_primitives(scene);
  Extents extents;
  for (const CanonicalPrimitive& primitive : *primitives) extents.push_back(extent_of(primitive));
  constexpr double kTolerance = 1e-8;  // for scenes of about size 10
  return leave_out_redundant(scene.model, *primitives, extents, kTolerance);
}

/// Makes a ball for each letter; equal letters mean equal balls.
Scene scene_of(const std::string& letters, const std::string& tree) {
  Scene scene;
  for (const char letter : letters) {
    scene.primitives.push_back(make_sphere(3, moved({2.0 * (letter - 'a'), 0, 0})));
  }
  scene.model = tree_of(tree);
  return scene;
}

std::string merged(const std::string& letters, const std::string& tree) {
  const Scene scene = scene_of(letters, tree);
  const auto result = lean_of(scene);
  return result ? text_of(*result) : "the same";
}

TEST(EqualOperands, TheLastIsLeft) {
  EXPECT_EQ(merged("aa", "(+ 0 1)"), "1");
  EXPECT_EQ(merged("abac", "(+ 0 1 2 3)"), "(+ 1 2 3)");
  EXPECT_EQ(merged("abab", "(* 0 1 2 3)"), "(* 2 3)");
  EXPECT_EQ(merged("abcb", "(- 0 1 2 3)"), "(- 0 2 3)");
  EXPECT_EQ(merged("aaaaa", "(- 0 1 2 3 4)"), "(- 0 4)");
  // File order decides, not the place in the tree.
  EXPECT_EQ(merged("aba", "(+ 2 1 0)"), "(+ 2 1)");
}

TEST(EqualOperands, OfDifferentOperationsAllStay) {
  EXPECT_EQ(merged("ab", "(+ 0 1)"), "the same");
  EXPECT_EQ(merged("aa", "(- 0 1)"), "the same");
  EXPECT_EQ(merged("aba", "(+ 0 (- 1 2))"), "the same");
  EXPECT_EQ(merged("abab", "(+ (- 0 1) (* 2 3))"), "the same");
}

TEST(EqualOperands, OperationsOfEqualOperandsAreEqual) {
  EXPECT_EQ(merged("abab", "(+ (- 0 1) (- 2 3))"), "(- 2 3)");
  EXPECT_EQ(merged("abcabcd", "(+ (- 0 (* 1 2)) (- 3 (* 4 5)) 6)"), "(+ (- 3 (* 4 5)) 6)");
  // The differences become equal once their own equal operands are gone.
  EXPECT_EQ(merged("abbab", "(+ (- 0 1 2) (- 3 4))"), "(- 3 4)");
  EXPECT_EQ(merged("abab", "(+ (- 0 1) (- 3 2))"), "the same");
  // The operation that is left merges into the one around it.
  EXPECT_EQ(merged("ababc", "(+ (* (+ 0 1) (+ 2 3)) 4)"), "(+ 2 3 4)");
  // Operands that interleave: the last might be the top of one, and the side of the other.
  EXPECT_EQ(merged("aabb", "(+ (- 0 2) (- 1 3))"), "the same");
}

TEST(EqualOperands, ToldByShapeNumbersAndMatrixAlone) {
  Scene scene = scene_of("aa", "(* 0 1)");
  const auto can_merge = [&] { return lean_of(scene).has_value(); };
  scene.primitives[1].color = Color{1, 0, 0, 1};
  scene.primitives[1].id = 7;
  EXPECT_TRUE(can_merge());
  const Primitive kept = scene.primitives[1];
  scene.primitives[1].as<SphereShape>().radius = 3.0000000001;
  EXPECT_FALSE(can_merge());
  scene.primitives[1] = kept;
  scene.primitives[1].local_to_world.linear[1][0] = 1e-9;
  EXPECT_FALSE(can_merge());
  scene.primitives[0] = make_frustum(0, 1, 2, 2);
  for (const Primitive& other : {make_frustum(0, 1, 2, 1), make_frustum(0, 1.5, 2, 2)}) {
    scene.primitives[1] = other;
    EXPECT_FALSE(can_merge());
  }
  const Box box{Vec3(0.0), Vec3(1, 2, 3)};
  scene.primitives = {make_polyhedron(Polyhedron::box(box)), make_polyhedron(Polyhedron::box(box))};
  EXPECT_TRUE(can_merge());
  scene.primitives[1] = make_polyhedron(Polyhedron::frustum(0, 1, 1, 1, 6));
  EXPECT_FALSE(can_merge());
}

TEST(EqualOperands, AreNotInTheSolidsList) {
  const Scene scene = scene_of("abacb", "(+ 0 1 2 (- 3 4))");
  EXPECT_THAT(named_by(Made(scene).solid), ElementsAre(1u, 2u, 3u, 4u));
  EXPECT_THAT(named_by(Made(scene_of("ab", "(+ 0 1)")).solid), ElementsAre(0u, 1u));
}

std::string lean(std::vector<Primitive> primitives, const std::string& tree) {
  Scene scene;
  scene.primitives = std::move(primitives);
  scene.model = tree_of(tree);
  const auto result = lean_of(scene);
  return result ? text_of(*result) : "the same";
}

TEST(InnerOperands, OfAUnionAreLeftOut) {
  const Primitive large = make_sphere(5), small = make_sphere(1, moved({1, 2, 0}));
  EXPECT_EQ(lean({large, small}, "(+ 0 1)"), "0");
  EXPECT_EQ(lean({small, large}, "(+ 0 1)"), "1");
  EXPECT_EQ(lean({large, small, make_sphere(1, moved({5, 0, 0}))}, "(+ 0 1 2)"), "(+ 0 2)");
  EXPECT_EQ(lean({make_sphere(9), large, small}, "(- 0 1 2)"), "(- 0 1)");
  EXPECT_EQ(lean({large, small}, "(* 0 1)"), "the same");
  EXPECT_EQ(lean({large, small}, "(- 0 1)"), "the same");
}

/// Parts that touch the surface from inside show there, if they come later.
TEST(InnerOperands, ThatShowAtTheSurfaceStay) {
  const auto slab = [](double top, double radius) { return make_frustum(0, top, radius, radius); };
  const auto prism = [](double top, double radius) {
    return make_polyhedron(Polyhedron::frustum(0, top, radius, radius, 6));
  };
  EXPECT_EQ(lean({slab(4, 3), slab(5, 3)}, "(+ 0 1)"), "1");
  EXPECT_EQ(lean({slab(5, 3), slab(4, 3)}, "(+ 0 1)"), "the same");
  EXPECT_EQ(lean({prism(4, 3), prism(5, 3)}, "(+ 0 1)"), "1");
  EXPECT_EQ(lean({prism(5, 3), prism(4, 3)}, "(+ 0 1)"), "the same");
  EXPECT_EQ(lean({prism(5, 3), make_frustum(1, 4, 2, 1)}, "(+ 0 1)"), "0");
  EXPECT_EQ(lean({make_frustum(0, 5, 3, 1), make_frustum(1, 4, 1, 1)}, "(+ 0 1)"), "0");
  EXPECT_EQ(lean({make_frustum(0, 5, 3, 1), make_frustum(1, 4, 2, 2)}, "(+ 0 1)"), "the same");
  EXPECT_EQ(lean({make_frustum(0, 5, 3, 1), make_frustum(1, 6, 1, 1)}, "(+ 0 1)"), "the same");
  EXPECT_EQ(lean({make_frustum(1, 4, 2, 2, moved({1.5, 0, 0})), slab(5, 3)}, "(+ 0 1)"),
            "the same");
  EXPECT_EQ(lean({make_sphere(1, moved({2, 0, 0})), make_sphere(3)}, "(+ 0 1)"), "1");
  EXPECT_EQ(lean({make_sphere(3), make_sphere(1, moved({2, 0, 0}))}, "(+ 0 1)"), "the same");
}

TEST(EqualOperands, AMillionPrimitivesOfFewKinds) {
  constexpr uint32_t kCount = 1000000;
  std::vector<Primitive> primitives;
  for (uint32_t i = 0; i < kCount; ++i) {
    primitives.push_back(make_sphere(1, moved({double(i * 7919 % 1000), 0, 0})));
  }
  const Scene scene = test_support::scene_of(Op::kUnion, std::move(primitives));
  const auto result = lean_of(scene);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->tokens().size(), 1001u);
}

/// A tree whose primitives are of few kinds, so that many are equal.
Scene tree_of_few_kinds(uint32_t seed) {
  std::mt19937 random(seed);
  Scene scene = test_support::random_tree(2 + random() % 30, seed);
  const size_t kinds = 1 + scene.primitives.size() / 4;
  for (size_t i = kinds; i < scene.primitives.size(); ++i) {
    const uint32_t id = scene.primitives[i].id;
    scene.primitives[i] = scene.primitives[random() % kinds];
    scene.primitives[i].id = id;
  }
  return scene;
}

/// The same tree without merging: primitives that differ in the last bit are not equal.
Scene with_tiny_differences(Scene scene) {
  for (size_t i = 0; i < scene.primitives.size(); ++i) {
    double& number = scene.primitives[i].local_to_world.linear[0][0];
    number *= 1 + 1e-15 * static_cast<double>(i);
  }
  return scene;
}

TEST(EqualOperands, PicturesAreThoseOfAllOperands) {
  std::mt19937 random(7);
  uint64_t left_out = 0;
  uint64_t pixels = 0;
  uint64_t differing = 0;
  const uint32_t trees = test_support::sample_size(60);
  for (uint32_t seed = 1; seed <= trees; ++seed) {
    const Made made(tree_of_few_kinds(seed));
    const Made apart(with_tiny_differences(made.scene));
    if (made.solid.bounds().empty()) continue;
    left_out += named_by(apart.solid).size() - named_by(made.solid).size();
    const View view = checks::view_of(made.solid.bounds(), checks::random_direction(random), 4);
    const Hits hits = checks::trace_by_tiles(made.solid, view);
    EXPECT_TRUE(checks::same_bits(hits, checks::WholeList(made.solid, view).picture()));
    const Hits others = checks::trace_by_tiles(apart.solid, view);
    for (size_t i = 0; i < hits.primitive.size(); ++i) {
      pixels += hits.primitive[i] != Hits::kMiss;
      differing += hits.primitive[i] != others.primitive[i];
    }
  }
  EXPECT_GT(left_out, 100u * trees / 60);
  EXPECT_GT(pixels, 10000u * trees / 60);
  // At silhouettes and edges the last bit decides.
  EXPECT_LE(differing, pixels / 1000);
}

}  // namespace
}  // namespace csgcore
