// Tests which primitive the reference shows where crossings coincide.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "reference_test_scenes.hpp"

namespace csgcore {
namespace {

using reference_test::ball;
using reference_test::down;
using reference_test::middle_hit;
using reference_test::rod;
using reference_test::scene_of;

// --- Which primitive is shown ---

TEST(ReferenceCoincidence, ShowsTheLastThatTurnsTheValue) {
  const Primitive wide = rod(0, 2, 5), narrow = rod(0, 2, 3), above = rod(2, 4, 3);
  EXPECT_EQ(middle_hit(scene_of(Op::kIntersection, {wide, narrow}), down(9)).primitive, 1u);
  EXPECT_EQ(middle_hit(scene_of(Op::kIntersection, {narrow, wide}), down(9)).primitive, 1u);
  // The ray leaves what is cut away, and enters what it is cut from: both turn the value.
  const ReferenceHit touching = middle_hit(scene_of(Op::kDifference, {wide, above}), down(9));
  EXPECT_EQ(touching.primitive, 1u);
  EXPECT_EQ(touching.normal.z, 1);
  // An inlay, plate − hole ∪ plug: plate and hole cancel each other, and only the plug turns the
  // value.
  const Scene inlay = scene_of({wide, rod(1, 2, 3), rod(1, 2, 3)}, [](CsgTreeBuilder& builder) {
    builder.open(Op::kUnion);
    builder.open(Op::kDifference);
    builder.primitive(0);
    builder.primitive(1);
    builder.close();
    builder.primitive(2);
    builder.close();
  });
  EXPECT_EQ(middle_hit(inlay, down(9)).primitive, 2u);
}

TEST(ReferenceCoincidence, WhatChangesAgainstTheValueIsNotShown) {
  EXPECT_EQ(middle_hit(scene_of(Op::kUnion, {rod(0, 2, 5), rod(0, 2, 3)}), down(9)).primitive, 1u);
  // Entering a cut is a change, too, but not in the value's direction, so that the cut is not
  // shown.
  const Scene beside_a_cut = scene_of({rod(0, 2, 5), rod(0, 2, 5), rod(-1, 1, 2), rod(-1, 2, 1)},
                                      [](CsgTreeBuilder& builder) {  // (2 − 3) ∪ 0 ∪ 1
                                        builder.open(Op::kUnion);
                                        builder.open(Op::kDifference);
                                        builder.primitive(2);
                                        builder.primitive(3);
                                        builder.close();
                                        builder.primitive(0);
                                        builder.primitive(1);
                                        builder.close();
                                      });
  EXPECT_EQ(middle_hit(beside_a_cut, down(9)).primitive, 1u);
  // Seen from inside the common part of two equal balls, both of which are left.
  const ReferenceHit leaving =
      middle_hit(scene_of(Op::kIntersection, {ball(2), ball(2)}), down(0.5));
  EXPECT_EQ(leaving.primitive, 1u);
  EXPECT_EQ(leaving.normal.z, -1);
  // Seen from inside a block, into two equal cuts at once.
  const ReferenceHit into_cuts =
      middle_hit(scene_of(Op::kDifference, {rod(-9, 9, 9), ball(2), ball(2)}), down(5));
  EXPECT_EQ(into_cuts.primitive, 2u);
  EXPECT_EQ(into_cuts.s, 3);
  EXPECT_EQ(into_cuts.normal.z, -1);  // out of the solid: into the cut
}

TEST(ReferenceCoincidence, APrimitiveWithinAClusterIsNeverShown) {
  // A sheet thinner than the tolerance lies on the block. It comes first, and alone.
  const Scene scene = scene_of(Op::kUnion, {rod(1, 1 + 1e-10, 5), rod(0, 1, 5)});
  const ReferenceHit hit = middle_hit(scene, down(9));
  EXPECT_EQ(hit.primitive, 1u);
  EXPECT_EQ(hit.s, 8);
  EXPECT_FALSE(middle_hit(scene_of(Op::kUnion, {rod(1, 1 + 1e-10, 5)}), down(9)).hit());
}

// --- Coincidences ---

TEST(ReferenceCoincidence, ClustersAreChainsOfBoundaries) {
  const double t = kReferenceThickness * std::sqrt(12.0);  // of the box [-1, 1]³
  // Sheets and gaps of 0.6 tolerances over a block: 3 tolerances in all, but one coincidence.
  std::vector<Primitive> sheets{rod(-1, 1, 1)};
  for (const int i : {1, 3}) sheets.push_back(rod(1 + 0.6 * i * t, 1 + 0.6 * (i + 1) * t, 1));
  EXPECT_EQ(middle_hit(scene_of(Op::kUnion, sheets), down(9)).primitive, 0u);
  EXPECT_EQ(
      middle_hit(scene_of(Op::kUnion, {sheets[0], rod(1.5, 1.5 + 1.2 * t, 1)}), down(9)).primitive,
      1u);
}

TEST(ReferenceCoincidence, WhatMakesNoDifferenceLinksNothingAndIsNotShown) {
  const double t = kReferenceThickness * std::sqrt(12.0);
  const Primitive block = rod(-1, 1, 1), aside = ball(0.1, {0.9, 0, 0});
  // A skin of 1.4 tolerances, and half-way through it a face that does not exist: its primitive is
  // cut with one that does not reach so far.
  const Scene skin = scene_of({block, rod(-2, 1 - 1.4 * t, 2), rod(-1, 1 - 0.7 * t, 1), aside},
                              [](CsgTreeBuilder& builder) {
                                builder.open(Op::kUnion);
                                builder.open(Op::kDifference);
                                builder.primitive(0);
                                builder.primitive(1);
                                builder.close();
                                builder.open(Op::kIntersection);
                                builder.primitive(2);
                                builder.primitive(3);
                                builder.close();
                                builder.close();
                              });
  EXPECT_EQ(middle_hit(skin, down(9)).primitive, 0u);
  // Two plugs flush with the top of the plate, where the plate is cut away.
  const Scene plugs = scene_of({block, rod(0, 2, 0.9), rod(0, 1, 0.5), rod(-1, 1, 0.5)},
                               [](CsgTreeBuilder& builder) {
                                 builder.open(Op::kUnion);
                                 builder.open(Op::kDifference);
                                 builder.primitive(0);
                                 builder.primitive(1);
                                 builder.close();
                                 builder.primitive(2);
                                 builder.primitive(3);
                                 builder.close();
                               });
  EXPECT_EQ(middle_hit(plugs, down(9)).primitive, 3u);
  EXPECT_EQ(middle_hit(plugs, down(1.5)).primitive, 3u);  // from within the cut
}

TEST(ReferenceCoincidence, CullingChangesNothing) {
  // The picture has blocks of pixels that primitive 2 reaches and others that it does not, for
  // which the tree is reduced. Primitive 3, which is intersected with primitive 2, is flush with
  // the others everywhere.
  const Scene scene =
      scene_of({rod(0, 1, 0.9), rod(-1, 1, 0.8), rod(-1, 1, 0.5, {1, 0, 0}), rod(-1, 1, 1)},
               [](CsgTreeBuilder& builder) {
                 builder.open(Op::kUnion);
                 builder.open(Op::kIntersection);
                 builder.primitive(2);
                 builder.primitive(3);
                 builder.close();
                 builder.primitive(0);
                 builder.primitive(1);
                 builder.close();
               });
  View view = down(9, Projection::kOrthographic);
  view.width_px = view.height_px = 100;
  const Reference reference(scene, view);
  const std::vector<ReferenceHit> picture = reference.picture();
  std::map<uint32_t, int> seen;
  for (uint32_t i = 0; i < picture.size(); i += 3) {
    ASSERT_EQ(picture[i].primitive, reference.at(i % 100, i / 100).primitive);
    ++seen[picture[i].primitive];
    const LongVec3& p = picture[i].position;
    const bool in_common = std::hypot(p.x - 1, p.y) < 0.5L;
    if (!picture[i].hit()) continue;
    ASSERT_EQ(picture[i].primitive == 3, in_common) << p.x << ' ' << p.y;
  }
  EXPECT_GT(seen[3], 100);
  EXPECT_GT(seen[1], 1000);
}

TEST(ReferenceCoincidence, ThicknessIsMeasuredAlongTheSteeperNormal) {
  // A ray that sinks by 1 in 100 meets a wall and, a bit further on, a top. Along the top's normal
  // their distance is a hundredth of that along the wall's.
  const auto first_seen = [](double gap_in_tolerances) {
    const double size = 10, tolerance = kReferenceThickness * size;
    View view;
    view.eye = {-4, 0, 0.04 + gap_in_tolerances * tolerance / 100};
    view.forward = glm::normalize(Vec3(1, 0, -0.01));
    view.right = {0, -1, 0};
    view.up = glm::cross(view.right, view.forward);
    view.width_px = view.height_px = 1;
    // The ray meets the top at x = gap; the wall is at x = 0 there.
    Scene scene = scene_of(Op::kUnion, {rod(-1, 1, 1, {1, 0, 0}), rod(-1, 0, 3)});
    return Reference(scene, view).at(0, 0).primitive;
  };
  EXPECT_EQ(first_seen(0.3), 1u);  // coincident: the last of the two is shown
  EXPECT_EQ(first_seen(3), 0u);    // not coincident: the wall comes first
  EXPECT_EQ(first_seen(60), 0u);   // 0.6 tolerances along the top's normal
}

TEST(ReferenceCoincidence, AShellIsWholeOrNotAtAll) {
  const double size = 2 * std::sqrt(3.0);
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
    View view = down(4, projection);
    view.half_height *= projection == Projection::kPerspective ? 30 : 1;
    view.width_px = view.height_px = 101;
    const auto hits = [&](double wall) {
      const Scene scene = scene_of(Op::kDifference, {ball(1), ball(1 - wall * size)});
      uint64_t count = 0;
      for (const ReferenceHit& hit : Reference(scene, view).picture()) count += hit.primitive == 0;
      return count;
    };
    const uint64_t all = hits(0.5);
    EXPECT_GT(all, 1000u);
    EXPECT_EQ(hits(1.1 * kReferenceThickness), all);
    EXPECT_EQ(hits(0.9 * kReferenceThickness), 0u);
  }
}

TEST(ReferenceCoincidence, AnEyeInAFaceSeesBothSidesOfIt) {
  // `two`: two blocks, one on the other, with the eye between them. `one`: one block with the eye
  // on it.
  const Scene two = scene_of(Op::kUnion, {rod(-1, 0, 1), rod(0, 1, 1)});
  const Scene one = scene_of(Op::kUnion, {rod(-1, 0, 1), rod(0.5, 1, 0.2)});
  View up = down(0);
  up.forward = -up.forward;
  up.right = -up.right;
  for (const double height : {-1e-11, -1e-17, 0.0, 1e-17, 1e-11}) {
    View view = down(height);
    up.eye.z = height;
    EXPECT_EQ(middle_hit(two, view).primitive, 0u);
    EXPECT_EQ(middle_hit(two, view).normal.z, -1);
    EXPECT_EQ(middle_hit(two, up).primitive, 1u);
    EXPECT_EQ(middle_hit(two, up).normal.z, 1);
    EXPECT_EQ(middle_hit(one, view).normal.z, -1);  // from inside
    EXPECT_EQ(middle_hit(one, up).primitive, 1u);   // from outside
    EXPECT_EQ(middle_hit(one, up).normal.z, -1);
  }
}

}  // namespace
}  // namespace csgcore
