// Tests offsets and Minkowski sums by their areas and boxes.
#include "plane/offset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "plane/figure_area.hpp"

namespace frontend {
namespace {

using ::testing::SizeIs;

const Polygon kEll{{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 6}, {0, 6}};

std::vector<Figure> ell() { return {outline_of(Polygons{kEll})}; }

std::vector<Figure> frame() {
  return {
      outline_of(Polygons{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{2, 2}, {8, 2}, {8, 8}, {2, 8}}})};
}

TEST(Offset, OfADiscIsADisc) {
  const std::vector<Figure> result =
      offset(std::vector<Figure>{Disc{Vec2(1, 2), 3}}, {.distance = 2}).value();
  ASSERT_THAT(result, SizeIs(1));
  EXPECT_EQ(std::get<Disc>(result[0]).radius, 5);
}

TEST(Offset, OfASquareHasFourArcs) {
  const std::vector<Figure> result =
      offset(std::vector<Figure>{rectangle(0, 0, 4, 2)}, {.distance = 0.5}).value();
  ASSERT_THAT(result, SizeIs(1));
  const Outline& outline = std::get<Outline>(result[0]);
  ASSERT_THAT(outline.loops, SizeIs(1));
  EXPECT_THAT(outline.loops[0], SizeIs(8));
  EXPECT_NEAR(area_of(result[0]), 8 + 6 + kPi / 4, kPi / 4 * kChordsShare);
}

TEST(Offset, FillsConcaveCornersOnce) {
  // A unit along the boundary of 24, six rounded corners less the concave one.
  EXPECT_NEAR(area_of_union(offset(ell(), {.distance = 1}).value()), 20 + 24 + 5 * kPi / 4 - 1,
              kPi * 1e-4);
}

TEST(Offset, NarrowsHolesAndClosesThem) {
  EXPECT_NEAR(area_of_union(offset(frame(), {.distance = 1}).value()), 100 + 40 + kPi - 16,
              kPi * 1e-4);
  EXPECT_NEAR(area_of_union(offset(frame(), {.distance = 3.5}).value()), 100 + 140 + 12.25 * kPi,
              12.25 * kPi * 1e-4);
}

TEST(Offset, InwardsKeepsConvexCornersSharp) {
  EXPECT_NEAR(area_of_union(offset(frame(), {.distance = -0.5}).value()), 81 - (49 - (1 - kPi / 4)),
              1e-4);
}

TEST(Offset, InFacetsIsOpenScads) {
  const std::vector<Figure> result =
      offset(std::vector<Figure>{rectangle(0, 0, 4, 4)}, {.distance = 1, .fragments = 8}).value();
  ASSERT_THAT(result, SizeIs(1));
  EXPECT_THAT(std::get<Outline>(result[0]).loops[0], SizeIs(12));
}

// The corners are those that OpenSCAD 2025.07.18 writes.
TEST(Offset, TurnsByWholeChordsAndTheRest) {
  const auto corners = [](const std::vector<Figure>& figures, double distance, int fragments) {
    const std::vector<Figure> result =
        offset(figures, {.distance = distance, .fragments = fragments, .has_chord_for_rest = true})
            .value();
    Polygon all;
    for (const csgcore::ProfileLoop& loop : std::get<Outline>(result.at(0)).loops)
      for (const csgcore::ProfileEdge& edge : loop) all.push_back(edge.end);
    return all;
  };
  const auto holds = [](const Polygon& polygon, const Vec2& corner) {
    return std::ranges::any_of(polygon,
                               [&](const Vec2& at) { return glm::length(at - corner) < 1e-5; });
  };
  const std::vector<Figure> square{rectangle(0, 0, 5, 5)};
  const Polygon outer = corners(square, 1, 5);
  EXPECT_THAT(outer, SizeIs(12));
  EXPECT_TRUE(holds(outer, {5.309017, 5.951057}));
  EXPECT_TRUE(holds(outer, {-0.951057, 5.309017}));
  EXPECT_THAT(corners(square, 1, 8), SizeIs(12)) << "nothing is left";
  EXPECT_THAT(corners(square, 10, 30), SizeIs(36));
  const std::vector<Figure> ring{
      outline_of(Polygons{{{-4.5, -4.5}, {4.5, -4.5}, {4.5, 4.5}, {-4.5, 4.5}},
                          {{-2.5, -2.5}, {-2.5, 2.5}, {2.5, 2.5}, {2.5, -2.5}}})};
  const Polygon inner = corners(ring, -1, 5);
  EXPECT_THAT(inner, SizeIs(16));
  EXPECT_TRUE(holds(inner, {-2.809017, 3.451057}));
  EXPECT_TRUE(holds(inner, {3.451057, 2.809017}));
  EXPECT_TRUE(holds(inner, {3.5, 3.5}));
}

// Long edges side by side have boxes that overlap, but do not cross.
TEST(Offset, OfThousandsOfSpikes) {
  const auto area = [](int corners, const OffsetSettings& settings) {
    Polygon star;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * kPi * i / corners, radius = i % 2 == 0 ? 100 : 60;
      star.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    const std::vector<Figure> spikes{outline_of(Polygons{star})};
    return area_of_union(offset(spikes, settings).value());
  };
  const double outwards =
      area(4000, {.distance = 0.001, .fragments = 5, .has_chord_for_rest = true});
  EXPECT_NEAR(outwards, kPi * 100 * 60 + 4000 * 40 * 0.001, 10);
  // Round corners between them would cross millions of times, and have fewer chords.
  EXPECT_NEAR(area(10'000, {.distance = -1}), kPi * 59 * 59, 100);
}

TEST(MinkowskiSum, OfConvexPolygons) {
  const std::vector<Figure> triangle{outline_of(Polygons{{{0, 0}, {1, 0}, {0, 1}}})};
  const std::vector<Figure> square{rectangle(0, 0, 2, 2)};
  const std::vector<Figure> sum = minkowski_sum(square, triangle).value();
  EXPECT_THAT(convex_corners(sum[0]).value(), SizeIs(5));
  EXPECT_EQ(area_of(sum[0]), 8.5);
}

TEST(MinkowskiSum, WithADiscIsAnOffset) {
  const std::vector<Figure> disc{Disc{Vec2(10, 0), 1}};
  for (const auto& sum : {minkowski_sum(ell(), disc), minkowski_sum(disc, ell())}) {
    EXPECT_NEAR(area_of_union(sum.value()), 20 + 24 + 5 * kPi / 4 - 1, kPi * 1e-4);
    EXPECT_NEAR(bounds_of((*sum)[0]).min.x, 9, 1e-12);
  }
}

TEST(MinkowskiSum, OfAFrameKeepsItsHole) {
  const std::vector<Figure> square{rectangle(0, 0, 1, 1)};
  EXPECT_NEAR(area_of_union(minkowski_sum(frame(), square).value()), 121 - 25, 1e-6);
  EXPECT_NEAR(area_of_union(minkowski_sum(square, frame()).value()), 121 - 25, 1e-6);
}

TEST(MinkowskiSum, OfPolygonsThatAreNotConvex) {
  // The corner sits in the ell's notch, and fills the frame of neither.
  const std::vector<Figure> sum = minkowski_sum(ell(), ell()).value();
  // Twice the ell, which is a square of 12 less one of 8, with the notch filled up to (4, 4).
  EXPECT_EQ(bounds_of(sum[0]).max, Vec2(12, 12));
  EXPECT_NEAR(area_of_union(sum), 12 * 4 + 8 * 4 + 4 * 4, 1e-6);
  // A small one in a frame leaves a hole.
  std::vector<Figure> small{outline_of(Polygons{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}})};
  EXPECT_NEAR(area_of_union(minkowski_sum(frame(), small).value()), 144 - 16 - 1, 1e-6);
}

TEST(MinkowskiSum, DistributesOverUnions) {
  const std::vector<Figure> two{rectangle(0, 0, 1, 1), rectangle(5, 0, 6, 1)};
  EXPECT_NEAR(area_of_union(minkowski_sum(two, two).value()), 3 * 4, 1e-6);
}

}  // namespace
}  // namespace frontend
