// Tests a subdivision that follows edits: its cells are valid, its picture is right, and it does no
// more work than needed.
#include <gtest/gtest.h>

#include <cmath>

#include "checks.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/tracer.hpp"
#include "edited_scenes.hpp"
#include "made.hpp"
#include "support/full_run.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

using checks::Made;
using checks::same_bits;

auto tuple_of(const Leaf& leaf) {
  return std::make_tuple(leaf.box.min.x, leaf.box.min.y, leaf.box.min.z, leaf.box.max.x,
                         leaf.box.max.y, leaf.box.max.z, leaf.first_test, leaf.test_count,
                         leaf.kind, leaf.solid);
}

/// Fails unless everything that update() reports as kept is unchanged.
void expect_kept(const Subdivision& before, const Subdivision& after,
                 const SubdivisionUpdate& update, const SceneEdit& edit) {
  if (update.is_anew) {
    EXPECT_EQ(update.leaves_made, after.leaves().size());
    EXPECT_EQ(update.leaves_kept, 0u);
    return;
  }
  const std::vector<uint32_t> later = edit.later_indices();
  ASSERT_EQ(update.first_new_leaf, before.leaves().size());
  ASSERT_EQ(update.first_new_test, before.tests().size());
  ASSERT_EQ(after.leaves().size(), update.first_new_leaf + update.leaves_made);
  uint64_t replaced = 0;
  for (size_t i = 0; i < before.leaves().size(); ++i) {
    const Leaf &was = before.leaves()[i], &is = after.leaves()[i];
    if (is.kind == LeafKind::kReplaced) {
      replaced += was.kind != LeafKind::kReplaced;
      continue;
    }
    ASSERT_EQ(tuple_of(was), tuple_of(is));
    for (uint32_t k = 0; k < is.test_count; ++k) {
      BlistTest test = before.tests_of(was)[k];
      // A primitive that was changed in place keeps its index.
      ASSERT_TRUE(edit.keeps_indices() || later[test.primitive] != SceneEdit::kGone);
      if (!edit.keeps_indices()) test.primitive = later[test.primitive] & 0x7FFFFFFFu;
      ASSERT_EQ(test, after.tests_of(is)[k]);
    }
  }
  EXPECT_EQ(replaced, update.leaves_replaced);
  EXPECT_EQ(update.leaves_kept + update.leaves_made, census(after).leaves());
  for (const Leaf& leaf : after.leaves().subspan(update.first_new_leaf)) {
    ASSERT_GE(leaf.first_test, update.first_new_test);
  }
}

/// Returns whether a changed primitive reaches the leaf's cell, before or after the edit.
bool is_reached(const Leaf& leaf, double overlap, const Made& before, const Made& after,
                const SceneEdit& edit) {
  const auto meets = [&](const Box& box) {
    for (int axis = 0; axis < 3; ++axis) {
      if (box.max[axis] < leaf.box.min[axis] - 2 * overlap) return false;
      if (box.min[axis] > leaf.box.max[axis] + 2 * overlap) return false;
    }
    return true;
  };
  for (const uint32_t i : edit.removed) {
    if (meets((*before.primitives)[i].bounds)) return true;
  }
  for (const uint32_t i : edit.added) {
    if (meets((*after.primitives)[i].bounds)) return true;
  }
  return false;
}

struct Counts {
  int in_part = 0, anew = 0;
};

void follow_edits(checks::Design& design, const SubdivisionOptions& options, int saves,
                  std::mt19937& random, Counts& counts) {
  auto before = std::make_unique<Made>(design.scene());
  Subdivision subdivision(before->solid, options);
  for (int save = 0; save < saves; ++save) {
    SCOPED_TRACE("save " + std::to_string(save));
    design.edit(random);
    Scene scene = design.scene();
    const SceneEdit edit = compare(before->scene, scene);
    auto after = std::make_unique<Made>(std::move(scene), *before, edit);
    const Subdivision earlier = subdivision;
    const SubdivisionUpdate update = subdivision.update(after->solid, edit, edit.model);
    ++(update.is_anew ? counts.anew : counts.in_part);
    ASSERT_EQ(&subdivision.solid(), &after->solid);
    ASSERT_NO_FATAL_FAILURE(expect_kept(earlier, subdivision, update, edit));
    for (size_t i = 0; !update.is_anew && i < update.first_new_leaf; ++i) {
      const Leaf& leaf = earlier.leaves()[i];
      if (leaf.kind == LeafKind::kReplaced) continue;
      if (subdivision.leaves()[i].kind == LeafKind::kReplaced) {
        ASSERT_TRUE(is_reached(leaf, earlier.overlap(), *before, *after, edit));
      }
    }
    if (!subdivision.nodes().empty()) checks::expect_correct(subdivision, after->scene, 2);
    if (options.budget_bytes > 0) {
      ASSERT_LE(subdivision.bytes(), options.budget_bytes);
    }
    const View view =
        checks::trace_views(after->solid.bounds(), 61, 45)[static_cast<size_t>(save) % 7].view;
    ASSERT_TRUE(same_bits(checks::trace_by_cells(subdivision, view),
                          checks::trace_by_tiles(after->solid, view)));
    before = std::move(after);
  }
}

TEST(SubdivisionUpdate, RandomEditsLeaveCellsValid) {
  const uint32_t rounds = test_support::full_run() ? 400 : 24;
  std::printf("%s run: %u designs\n", test_support::full_run() ? "full" : "sample", rounds);
  std::mt19937 random(1);
  Counts counts;
  for (uint32_t round = 0; round < rounds; ++round) {
    SCOPED_TRACE("design " + std::to_string(round));
    SubdivisionOptions options;
    options.leaf_primitives = round % 2 ? 2 : 8;
    options.split = round % 5 == 0 ? SplitRule::kCyclic : SplitRule::kSurfaceArea;
    options.stop_at_unions = round % 7 == 0;
    checks::Design design(checks::framed_tree(20 + round % 50 * 4, round));
    ASSERT_NO_FATAL_FAILURE(follow_edits(design, options, 12, random, counts));
  }
  EXPECT_GT(counts.in_part, counts.anew / 2);
}

/// Edits stay within the budget; where they cannot, all is made anew.
TEST(SubdivisionUpdate, EditsKeepToTheBudget) {
  std::mt19937 random(5);
  Counts counts;
  for (uint32_t round = 0; round < 6; ++round) {
    SCOPED_TRACE("design " + std::to_string(round));
    checks::Design design(checks::framed_tree(60, round));
    SubdivisionOptions options;
    options.leaf_primitives = 2;
    const Made made(design.scene());
    // A budget of a bit more than is needed, and one of less.
    const uint64_t bytes = Subdivision(made.solid, options).bytes();
    options.budget_bytes = round % 2 ? bytes + bytes / 8 : bytes / 2;
    ASSERT_NO_FATAL_FAILURE(follow_edits(design, options, 10, random, counts));
  }
  EXPECT_GT(counts.in_part, 0);
  EXPECT_GT(counts.anew, 0);
}

/// An edit touches few leaves, and however many edits follow, what is stored stays bounded.
TEST(SubdivisionUpdate, OnePrimitiveTouchesFewLeaves) {
  Scene scene = test_support::cylinder_minus_spheres(1000);
  auto before = std::make_unique<Made>(scene);
  Subdivision subdivision(before->solid, {});
  const uint64_t stored = subdivision.tests().size();
  const uint64_t leaves = census(subdivision).leaves();
  std::mt19937 random(2);
  int anew = 0;
  for (int save = 0; save < 400; ++save) {
    Primitive& primitive = scene.primitives[1 + random() % 1000];
    primitive.local_to_world.translation += 0.2 * checks::random_direction(random);
    const SceneEdit edit = compare(before->scene, scene);
    auto after = std::make_unique<Made>(scene, *before, edit);
    const SubdivisionUpdate update = subdivision.update(after->solid, edit, edit.model);
    before = std::move(after);
    anew += update.is_anew;
    ASSERT_TRUE(update.is_anew || update.leaves_replaced < leaves / 10);
    ASSERT_LT(subdivision.tests().size(), 3 * stored);
    ASSERT_LT(census(subdivision).leaves(), 2 * leaves);
  }
  EXPECT_GT(anew, 0);
  EXPECT_LT(anew, 40);
  checks::expect_correct(subdivision, scene, 1);
}

TEST(SubdivisionUpdate, ColorsTouchNone) {
  Scene scene = test_support::cylinder_minus_spheres(100);
  const Made before(scene);
  Subdivision subdivision(before.solid, {});
  const uint64_t leaves = subdivision.leaves().size();
  scene.primitives[7].color = Color{1, 0, 0, 1};
  const SceneEdit edit = compare(before.scene, scene);
  const Made after(scene, before, edit);
  const SubdivisionUpdate update = subdivision.update(after.solid, edit, edit.model);
  EXPECT_FALSE(update.is_anew);
  EXPECT_EQ(update.leaves_kept, leaves);
  EXPECT_EQ(update.leaves_made, 0u);
  EXPECT_EQ(&subdivision.solid(), &after.solid);
}

/// Cells inside a primitive, before and after, do not depend on its surface.
TEST(SubdivisionUpdate, CellsDeepInsideAreKept) {
  // A box with bubbles in it, between two balls that fix the bounds.
  Scene scene;
  CsgTreeBuilder builder;
  const auto add = [&](const Primitive& primitive) {
    builder.primitive(static_cast<uint32_t>(scene.primitives.size()));
    scene.primitives.push_back(primitive);
  };
  const auto box = [](double half) {
    return make_polyhedron(Polyhedron::box({Vec3(-half), Vec3(half)}));
  };
  std::mt19937 random(3);
  builder.open(Op::kDifference);
  add(box(10));
  for (int i = 0; i < 300; ++i) {
    const Vec3 place = checks::random_point(random, {Vec3(-8.0), Vec3(8.0)});
    add(make_sphere(0.5, checks::moved(place)));
  }
  builder.close();
  add(make_sphere(1, checks::moved(Vec3(-14.0))));
  add(make_sphere(1, checks::moved(Vec3(14.0))));
  scene.model = builder.finish();
  const Made before(scene);
  Subdivision subdivision(before.solid, {});
  scene.primitives[0] = box(9.9);
  const SceneEdit edit = compare(before.scene, scene);
  const Made after(scene, before, edit);
  const SubdivisionUpdate update = subdivision.update(after.solid, edit, edit.model);
  EXPECT_FALSE(update.is_anew);
  EXPECT_GT(update.leaves_kept, update.leaves_replaced);
  checks::expect_correct(subdivision, scene, 2);
}

/// A ball comes so near to a cell that the cell's Blist, which is valid a bit beyond the cell,
/// needs it.
TEST(SubdivisionUpdate, WhatComesWithinTheOverlapCounts) {
  const double overlap = cell_overlap({Vec3(-3.0), Vec3(3.0)});
  std::vector<Primitive> balls;
  std::mt19937 random(4);
  for (const Vec3& place : {Vec3{-2, -2, 0}, Vec3{-2, 2, 0}, Vec3{1 + 2 * overlap, 0, 0},
                            Vec3{2, 0, 0}, Vec3{2, 0, 2}, Vec3{2, 0, -2}}) {
    balls.push_back(make_sphere(1, checks::moved(place)));
  }
  for (int i = 0; i < 60; ++i) {  // so that there is much to keep
    const Vec3 place = checks::random_point(random, {{1.5, -2.5, -2.5}, {2.5, -1.5, 2.5}});
    balls.push_back(make_sphere(0.1, checks::moved(place)));
  }
  Scene scene = checks::scene_of(Op::kUnion, balls);
  const Made before(scene);
  SubdivisionOptions options;
  options.leaf_primitives = 3;
  options.split = SplitRule::kCyclic;  // divided at x = 0
  Subdivision subdivision(before.solid, options);
  scene.primitives[2] = make_sphere(1, checks::moved({1 + 0.5 * overlap, 0, 0}));
  scene.primitives[2].id = 2;
  const SceneEdit edit = compare(before.scene, scene);
  const Made after(scene, before, edit);
  const Leaf* const below = subdivision.find({-1e-9, 0, 0});
  ASSERT_EQ(below->box.max.x, 0);
  const auto names_it = [&] {
    bool found = false;
    for (const BlistTest& test : subdivision.tests_of(*subdivision.find({-1e-9, 0, 0}))) {
      found |= test.primitive == 2;
    }
    return found;
  };
  ASSERT_FALSE(names_it());
  EXPECT_FALSE(subdivision.update(after.solid, edit, edit.model).is_anew);
  EXPECT_TRUE(names_it());
}

/// A cell may name a primitive that a closer look finds outside of it. No cell does so once that
/// primitive is removed.
TEST(SubdivisionUpdate, NoCellNamesWhatIsGone) {
  uint64_t found = 0;
  for (const uint32_t seed : {7u, 9u}) {
    Scene scene = test_support::cylinder_minus_cones(300, seed);
    const auto tree_of = [](uint32_t primitives) {
      CsgTreeBuilder builder;
      builder.open(Op::kDifference);
      for (uint32_t i = 0; i < primitives; ++i) builder.primitive(i);
      builder.close();
      return builder.finish();
    };
    const Made before(scene);
    SubdivisionOptions options;
    options.leaf_primitives = 2;
    const Subdivision earlier(before.solid, options);
    for (const Leaf& leaf : earlier.leaves()) {
      const Box cell{leaf.box.min - earlier.overlap(), leaf.box.max + earlier.overlap()};
      for (const BlistTest& test : earlier.tests_of(leaf)) {
        if (classify((*before.primitives)[test.primitive], cell) == Classification::kCrosses) {
          continue;
        }
        ++found;
        Scene less = scene;
        less.primitives.erase(less.primitives.begin() + test.primitive);
        less.model = tree_of(static_cast<uint32_t>(less.primitives.size()));
        const SceneEdit edit = compare(scene, less);
        ASSERT_EQ(edit.model, TreeEdit::kWithin);
        const Made after(less, before, edit);
        Subdivision subdivision = earlier;
        const SubdivisionUpdate update = subdivision.update(after.solid, edit, edit.model);
        ASSERT_FALSE(update.is_anew);
        expect_kept(earlier, subdivision, update, edit);
      }
    }
  }
  EXPECT_GT(found, 0u);
}

TEST(SubdivisionUpdate, OtherBoundsAreSubdividedAnew) {
  Scene scene =
      checks::scene_of(Op::kUnion, {make_sphere(1), make_sphere(1, checks::moved({9, 0, 0})),
                                    make_sphere(1, checks::moved({0, 9, 0}))});
  SubdivisionOptions options;
  options.leaf_primitives = 1;
  for (const double x : {10.0, 8.0}) {
    const Made before(scene);
    Subdivision subdivision(before.solid, options);
    scene.primitives[1].local_to_world.translation.x = x;
    const SceneEdit edit = compare(before.scene, scene);
    const Made after(scene, before, edit);
    EXPECT_TRUE(subdivision.update(after.solid, edit, edit.model).is_anew);
    EXPECT_EQ(subdivision.root_box().max, Subdivision(after.solid, options).root_box().max);
  }
}

/// Coincident surfaces are left in one cell, and edits do not divide it.
TEST(SubdivisionUpdate, CoincidentSurfacesStayInOneCell) {
  std::vector<Primitive> parts;
  for (int i = 0; i < 12; ++i) {  // turned, so that none are equal, and none is inside another
    const double c = std::cos(0.1 * i), s = std::sin(0.1 * i);
    parts.push_back(make_frustum(-1 - i % 3, 1 - i % 3, 4, 4,
                                 {Mat3{Vec3(c, s, 0), Vec3(-s, c, 0), Vec3(0, 0, 1)}, Vec3(0.0)}));
  }
  for (int i = 0; i < 400; ++i) {  // so that there is much to keep
    parts.push_back(make_sphere(0.5, checks::moved({1.2 * (i % 20), 10 + 1.2 * (i / 20), 0})));
  }
  Scene scene = checks::scene_of(Op::kUnion, parts);
  auto before = std::make_unique<Made>(scene);
  Subdivision subdivision(before->solid, {});
  const uint64_t leaves = census(subdivision).leaves();
  ASSERT_GT(census(subdivision).by_kind[size_t(LeafKind::kFull)], 0u);
  for (int save = 1; save <= 2; ++save) {
    scene.primitives[3].r_bottom = 4 - 0.001 * save;
    const SceneEdit edit = compare(before->scene, scene);
    auto after = std::make_unique<Made>(scene, *before, edit);
    EXPECT_FALSE(subdivision.update(after->solid, edit, edit.model).is_anew);
    before = std::move(after);
    EXPECT_LT(census(subdivision).leaves(), 2 * leaves);
  }
  checks::expect_correct(subdivision, scene, 1);
}

TEST(SubdivisionUpdate, ThresholdsAreSubdividedAnew) {
  Scene scene = test_support::cylinder_minus_spheres(100);
  const Made before(scene);
  const View view =
      checks::view_of(before.solid.bounds(), {0, 1, 0}, 4 * before.solid.bounds().diagonal());
  const auto options = SubdivisionOptions::paper(4, view);
  Subdivision subdivision(before.solid, options);
  scene.primitives[7].local_to_world.translation.z += 1;
  const SceneEdit edit = compare(before.scene, scene);
  const Made after(scene, before, edit);
  EXPECT_TRUE(subdivision.update(after.solid, edit, edit.model).is_anew);
  EXPECT_EQ(census(subdivision).leaves(), census(Subdivision(after.solid, options)).leaves());
}

}  // namespace
}  // namespace csgcore
