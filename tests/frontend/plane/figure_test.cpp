// Tests plane figures: their corners, images, boxes and halves.
#include "plane/figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plane/figure_area.hpp"

namespace frontend {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

std::optional<Polygon> corners_of(const Polygon& polygon) {
  return convex_corners(outline_of(Polygons{polygon}));
}

/// A curve from (0, 0) to (4, 0) whose top is at (2, 3), and a line back.
Outline arch() {
  csgcore::ProfileEdge curve;
  curve.kind = csgcore::ProfileEdge::Kind::kBezier;
  curve.control = {2, 6};
  curve.end = {4, 0};
  return {{{curve, csgcore::ProfileEdge{}}}, csgcore::FillRule::kNonZero};
}

TEST(BezierCurves, HaveTheirBox) {
  EXPECT_EQ(bounds_of(arch()).min, Vec2(0, 0));
  EXPECT_EQ(bounds_of(arch()).max, Vec2(4, 3));
  PlaneMap turn;
  turn.linear = glm::dmat2(0.6, 0.8, -0.8, 0.6);
  turn.translation = {7, 5};
  const Rectangle box = bounds_of(turn, arch());
  const Rectangle expected = bounds_of(mapped(turn, arch()));
  EXPECT_EQ(box.min, expected.min);
  EXPECT_EQ(box.max, expected.max);
  Rectangle near;
  for (int i = 0; i <= 1000; ++i) {
    const double t = i / 1000.0;
    near.merge(turn.point({4 * t, 12 * t * (1 - t)}));
  }
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(box.min[axis], near.min[axis], 1e-5);
    EXPECT_NEAR(box.max[axis], near.max[axis], 1e-5);
  }
}

TEST(BezierCurves, HaveAsManyChordsAsTheirFigureNeeds) {
  const Polygons alone = chords_of(arch());
  EXPECT_GT(alone[0].size(), 100u);
  EXPECT_LT(alone[0].size(), 200u);
  Outline beside = arch();
  for (csgcore::ProfileEdge& edge : beside.loops[0]) {
    edge.end *= 0.01;
    edge.control *= 0.01;
  }
  beside.loops.push_back(arch().loops[0]);
  const Polygons both = chords_of(beside);
  EXPECT_LT(both[0].size(), 30u);
  EXPECT_EQ(both[1].size(), alone[0].size());
  // The chords' middles are as near as those of a circle's.
  for (size_t i = 1; i + 2 < alone[0].size(); ++i) {
    const Vec2 middle = (alone[0][i] + alone[0][i + 1]) / 2.0;
    EXPECT_NEAR(middle.y, 3 * middle.x * (4 - middle.x) / 4, 1e-4 * 2);
  }
}

TEST(ConvexCorners, LeaveOutWhatIsNoCorner) {
  EXPECT_THAT(corners_of({{0, 0}, {1, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}}).value(),
              ElementsAre(Vec2(0, 0), Vec2(2, 0), Vec2(2, 2), Vec2(0, 2)));
  // The first point is no corner either, and a spike runs out and back.
  EXPECT_THAT(corners_of({{1, 0}, {2, 0}, {2, 2}, {2, 5}, {2, 2}, {0, 2}, {0, 0}}).value(),
              SizeIs(4));
}

TEST(ConvexCorners, RunCounterclockwise) {
  EXPECT_GT(area_of(Polygons{corners_of({{0, 0}, {0, 2}, {2, 2}, {2, 0}}).value()}), 0);
}

TEST(ConvexCorners, AreThoseOfConvexPolygonsAlone) {
  EXPECT_FALSE(corners_of({{0, 0}, {2, 0}, {2, 2}, {1, 0.5}})) << "a notch";
  EXPECT_FALSE(corners_of({{0, 0}, {2, 2}, {2, 0}, {0, 2}})) << "a bow tie";
  EXPECT_FALSE(corners_of({{0, 0}, {1, 0}, {2, 0}})) << "no area";
  Polygon star = circle_polygon({Vec2(0.0), 1}, 5);
  star = {star[0], star[2], star[4], star[1], star[3]};
  EXPECT_FALSE(corners_of(star)) << "it turns left everywhere, twice around";
  Polygon twice = circle_polygon({Vec2(0.0), 1}, 4);
  twice.insert(twice.end(), twice.begin(), twice.end());
  EXPECT_FALSE(corners_of(twice)) << "even-odd, it is empty";
}

TEST(CirclePolygon, IsOpenScads) {
  EXPECT_THAT(circle_polygon({Vec2(1, 1), 2}, 4),
              ElementsAre(Vec2(3, 1), Vec2(1, 3), Vec2(-1, 1), Vec2(1, -1)));
}

TEST(MappedFigure, KeepsDiscsUnderSimilarities) {
  PlaneMap map;
  map.linear = glm::dmat2(0, 2, 2, 0);  // a mirror, twice as large
  map.translation = Vec2(1, 0);
  const Figure image = mapped(map, Disc{Vec2(1, 0), 3});
  EXPECT_EQ(std::get<Disc>(image).center, Vec2(1, 2));
  EXPECT_EQ(std::get<Disc>(image).radius, 6);
}

TEST(MappedFigure, MakesChordsOfEllipses) {
  PlaneMap map;
  map.linear = glm::dmat2(3, 0, 0, 1);
  const Figure image = mapped(map, Disc{Vec2(0.0), 1});
  EXPECT_TRUE(is_polygonal(image));
  EXPECT_NEAR(area_of(image), 3 * kPi, 3 * kPi * kChordsShare);
}

TEST(MappedFigure, MirrorsArcs) {
  PlaneMap mirror;
  mirror.linear = glm::dmat2(-1, 0, 0, 1);
  // A half disc right of x = 0.
  const Outline half = right_half(Disc{Vec2(0.0), 2});
  const Figure image = mapped(mirror, half);
  EXPECT_NEAR(bounds_of(image).min.x, -2, 1e-12);
  EXPECT_NEAR(bounds_of(image).max.x, 0, 1e-12);
  EXPECT_NEAR(area_of(image), -area_of(half), 1e-12);
}

TEST(BoundsOfFigure, HoldArcs) {
  const Rectangle box = bounds_of(outline_of(Disc{Vec2(1, 2), 3}));
  EXPECT_NEAR(box.min.x, -2, 1e-12);
  EXPECT_NEAR(box.min.y, -1, 1e-12);
  EXPECT_NEAR(box.max.x, 4, 1e-12);
  EXPECT_NEAR(box.max.y, 5, 1e-12);
}

TEST(RightHalf, CutsDiscsAtTheAxis) {
  // A segment of half angle acos(1/2), about a centre left of the axis.
  const Outline small = right_half(Disc{Vec2(-1, 5), 2});
  const double half = kPi / 3;
  const double expected = 4 * half - 2 * std::sin(half);
  EXPECT_NEAR(area_of(small), expected, 4 * kPi * kChordsShare);
  EXPECT_GE(bounds_of(small).min.x, 0);
  EXPECT_NEAR(area_of(right_half(Disc{Vec2(1, 5), 2})), 4 * kPi - expected, 4 * kPi * kChordsShare);
  EXPECT_NEAR(area_of(right_half(Disc{Vec2(5, 5), 2})), 4 * kPi, 4 * kPi * kChordsShare);
  EXPECT_EQ(area_of(right_half(Disc{Vec2(-5, 5), 2})), 0);
}

TEST(RightHalf, CutsPolygonsAtTheAxis) {
  EXPECT_EQ(area_of(right_half(rectangle(-1, 0, 3, 2))), 6);
  EXPECT_EQ(area_of(right_half(rectangle(1, 0, 3, 2))), 4);
  EXPECT_EQ(area_of(right_half(rectangle(-3, 0, -1, 2))), 0);
}

}  // namespace
}  // namespace frontend
