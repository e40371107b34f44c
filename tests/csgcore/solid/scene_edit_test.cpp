// Tests what compare() finds between two scenes.
#include "csgcore/scene_edit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "checks.hpp"
#include "csgcore/polyhedron.hpp"
#include "edited_scenes.hpp"
#include "support/evaluate_tree.hpp"
#include "trace_scenes.hpp"

namespace csgcore {
namespace {

using checks::moved;
using checks::scene_of;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<Primitive> balls(std::initializer_list<double> places) {
  std::vector<Primitive> primitives;
  for (const double x : places) primitives.push_back(make_sphere(1, moved({x, 0, 0})));
  return primitives;
}

TEST(SceneEdit, NothingHasChanged) {
  const Scene scene = test_support::random_tree(30, 1);
  const SceneEdit edit = compare(scene, scene);
  EXPECT_TRUE(edit.nothing());
  EXPECT_TRUE(edit.surfaces_only());
  EXPECT_TRUE(edit.keeps_indices());
  EXPECT_EQ(edit.model, TreeEdit::kSame);
  EXPECT_TRUE(compare(Scene{}, Scene{}).nothing());
}

TEST(SceneEdit, ColorsAlone) {
  const Scene before = test_support::random_tree(30, 1);
  Scene after = before;
  after.primitives[3].color = Color{1, 0, 0, 1};
  after.primitives[17].color = Color{0, 1, 0, 1};
  const SceneEdit edit = compare(before, after);
  EXPECT_FALSE(edit.nothing());
  EXPECT_TRUE(edit.surfaces_only());
  EXPECT_THAT(edit.recolored, ElementsAre(3, 17));
  EXPECT_TRUE(compare(after, after).nothing());
  EXPECT_THAT(compare(after, before).recolored, ElementsAre(3, 17));
}

TEST(SceneEdit, IdsAlone) {
  const Scene before = test_support::random_tree(30, 1);
  Scene after = before;
  after.primitives[29].id = 31;
  const SceneEdit edit = compare(before, after);
  EXPECT_TRUE(edit.has_other_ids);
  EXPECT_TRUE(edit.surfaces_only());
  EXPECT_FALSE(edit.nothing());
}

TEST(SceneEdit, ChangedInPlace) {
  const Scene before = test_support::random_tree(30, 1);
  Scene after = before;
  after.primitives[2].local_to_world.translation.x += 1e-9;
  after.primitives[20] = make_sphere(3);
  after.primitives[20].id = 20;
  after.primitives[20].color = Color{1, 0, 0, 1};
  const SceneEdit edit = compare(before, after);
  EXPECT_THAT(edit.removed, ElementsAre(2, 20));
  EXPECT_THAT(edit.added, ElementsAre(2, 20));
  EXPECT_THAT(edit.recolored, IsEmpty());
  EXPECT_TRUE(edit.keeps_indices());
  EXPECT_FALSE(edit.surfaces_only());
  EXPECT_EQ(edit.model, TreeEdit::kSame);
}

TEST(SceneEdit, EachParameterCounts) {
  const Primitive frustum = make_frustum(-1, 2, 3, 4);
  const auto differs = [&](auto&& change) {
    Primitive other = frustum;
    change(other);
    return !same_shape(frustum, other) && !same_shape(other, frustum);
  };
  EXPECT_TRUE(same_shape(frustum, frustum));
  EXPECT_TRUE(differs([](Primitive& p) { p.solid = SphereShape{4}; }));
  EXPECT_TRUE(differs([](Primitive& p) { p.as<FrustumShape>().z_min = -2; }));
  EXPECT_TRUE(differs([](Primitive& p) { p.as<FrustumShape>().z_max = 1; }));
  EXPECT_TRUE(differs([](Primitive& p) { p.as<FrustumShape>().r_bottom = 1; }));
  EXPECT_TRUE(differs([](Primitive& p) { p.as<FrustumShape>().r_top = 1; }));
  EXPECT_TRUE(differs([](Primitive& p) { p.local_to_world.linear[1][2] = 1e-300; }));
  EXPECT_TRUE(differs([](Primitive& p) { p.local_to_world.translation.z = 1e-300; }));
  EXPECT_FALSE(differs([](Primitive& p) { p.color = Color{}; }));
  EXPECT_FALSE(differs([](Primitive& p) { p.id = 7; }));
}

/// Each import makes polyhedra of its own.
TEST(SceneEdit, PolyhedraAreComparedByTheirNumbers) {
  const auto box = [](double size) {
    return make_polyhedron(Polyhedron::box({Vec3(0.0), Vec3(size)}));
  };
  EXPECT_TRUE(same_shape(box(1), box(1)));
  EXPECT_FALSE(same_shape(box(1), box(2)));
  EXPECT_TRUE(same_shape(make_polyhedron(Polyhedron::sphere(2, 9)),
                         make_polyhedron(Polyhedron::sphere(2, 9))));
  EXPECT_FALSE(same_shape(make_polyhedron(Polyhedron::sphere(2, 9)),
                          make_polyhedron(Polyhedron::sphere(2, 10))));
}

TEST(SceneEdit, InsertedAndRemoved) {
  for (const Op op : {Op::kUnion, Op::kDifference}) {
    const Scene before = scene_of(op, balls({0, 1, 2, 3}));
    const Scene after = scene_of(op, balls({0, 1, 1.5, 2, 3}));
    const SceneEdit in = compare(before, after);
    EXPECT_THAT(in.removed, IsEmpty());
    EXPECT_THAT(in.added, ElementsAre(2));
    EXPECT_EQ(in.model, TreeEdit::kWithin);
    EXPECT_TRUE(in.has_other_ids);
    EXPECT_FALSE(in.keeps_indices());
    EXPECT_THAT(in.later_indices(), ElementsAre(0, 1, 3, 4));
    const SceneEdit out = compare(after, before);
    EXPECT_THAT(out.removed, ElementsAre(2));
    EXPECT_THAT(out.added, IsEmpty());
    EXPECT_EQ(out.model, TreeEdit::kWithin);
    EXPECT_THAT(out.later_indices(), ElementsAre(0, 1, SceneEdit::kGone, 2, 3));
  }
  // Removing the last primitive changes no id.
  const SceneEdit last =
      compare(scene_of(Op::kUnion, balls({0, 1})), scene_of(Op::kUnion, balls({0, 1, 2})));
  EXPECT_THAT(last.added, ElementsAre(2));
  EXPECT_FALSE(last.has_other_ids);
  EXPECT_EQ(last.model, TreeEdit::kWithin);
}

TEST(SceneEdit, WhatChangesTheWholeIsKnownNowhere) {
  const auto model_edit = [](const Scene& before, const Scene& after) {
    return compare(before, after).model;
  };
  const Scene both = scene_of(Op::kIntersection, balls({0, 1}));
  EXPECT_EQ(model_edit(both, scene_of(Op::kIntersection, balls({0, 1, 2}))), TreeEdit::kAnywhere);
  EXPECT_EQ(model_edit(both, scene_of(Op::kIntersection, balls({0, 1.5}))), TreeEdit::kSame);
  EXPECT_EQ(model_edit(both, scene_of(Op::kUnion, balls({0, 1}))), TreeEdit::kAnywhere);
  // The operand that was subtracted becomes the one that is subtracted from.
  const Scene difference = scene_of(Op::kDifference, balls({0, 1, 2}));
  EXPECT_EQ(model_edit(difference, scene_of(Op::kDifference, balls({1, 2}))), TreeEdit::kAnywhere);
  // All is gone, or new: the solid is known wherever no primitive reaches.
  EXPECT_EQ(model_edit(difference, Scene{}), TreeEdit::kWithin);
  EXPECT_EQ(model_edit(Scene{}, difference), TreeEdit::kWithin);
}

TEST(SceneEdit, LayersAreComparedApartFromTheModel) {
  Scene before = scene_of(Op::kUnion, balls({0, 1, 2, 3}));
  Scene after = before;
  EXPECT_TRUE(compare(before, after).surfaces_only());
  CsgTreeBuilder builder;
  builder.primitive(3);
  after.layers.push_back({Layer::Kind::kHighlight, true, builder.finish()});
  const SceneEdit edit = compare(before, after);
  EXPECT_EQ(edit.model, TreeEdit::kSame);
  EXPECT_TRUE(edit.has_other_layers);
  EXPECT_FALSE(edit.surfaces_only());
  before.layers = after.layers;
  EXPECT_FALSE(compare(before, after).has_other_layers);
  after.layers[0].shows_behind = false;
  EXPECT_TRUE(compare(before, after).has_other_layers);
  after.layers[0] = {Layer::Kind::kBackground, true, before.layers[0].solid};
  EXPECT_TRUE(compare(before, after).has_other_layers);
}

TEST(SceneEdit, OtherCutFacesAreAnotherColor) {
  const Scene before = scene_of(Op::kUnion, balls({0, 1}));
  Scene after = before;
  after.primitives[1].cut_faces = CutFaces::kAlways;
  EXPECT_EQ(compare(before, after).recolored, std::vector<uint32_t>{1});
}

TEST(SceneEdit, RandomEditsKeepWhatTheySay) {
  std::mt19937 random(1);
  int partial = 0, same_points = 0;
  for (uint32_t round = 0; round < 600; ++round) {
    checks::Design design(checks::framed_tree(2 + round % 40, round));
    const Scene before = design.scene();
    for (uint32_t i = 0; i <= round % 3; ++i) design.edit(random);
    const Scene after = design.scene();
    const SceneEdit edit = compare(before, after);
    const std::vector<uint32_t> later = edit.later_indices();
    ASSERT_EQ(later.size(), before.primitives.size());
    ASSERT_TRUE(std::is_sorted(edit.removed.begin(), edit.removed.end()));
    ASSERT_TRUE(std::is_sorted(edit.added.begin(), edit.added.end()));
    std::vector<uint8_t> known(after.primitives.size());
    for (const uint32_t i : edit.added) known[i] = 1;
    for (uint32_t i = 0; i < later.size(); ++i) {
      const bool gone = std::count(edit.removed.begin(), edit.removed.end(), i) == 1;
      ASSERT_EQ(gone, later[i] == SceneEdit::kGone);
      if (gone) continue;
      ASSERT_TRUE(same_shape(before.primitives[i], after.primitives[later[i]]));
      ASSERT_EQ(before.primitives[i].color != after.primitives[later[i]].color,
                std::count(edit.recolored.begin(), edit.recolored.end(), later[i]) == 1);
      ++known[later[i]];
    }
    EXPECT_THAT(known, testing::Each(1));
    if (edit.model == TreeEdit::kAnywhere) continue;
    ++partial;
    for (int i = 0; i < 40; ++i) {
      const Vec3 point = checks::random_point(random, {Vec3(-9.0), Vec3(9.0)});
      const auto is_in = [&](const Scene& scene, const std::vector<uint32_t>& primitives) {
        return std::any_of(primitives.begin(), primitives.end(), [&](uint32_t primitive) {
          return checks::holds(scene.primitives[primitive], point);
        });
      };
      if (is_in(before, edit.removed) || is_in(after, edit.added)) continue;
      ASSERT_EQ(checks::holds(before, point), checks::holds(after, point));
      ++same_points;
    }
  }
  EXPECT_GT(partial, 450);
  EXPECT_GT(same_points, 10000);
}

}  // namespace
}  // namespace csgcore
