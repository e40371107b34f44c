// Tests operations on plane figures that yield polygons.
#include "plane/outlines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "plane/figure_area.hpp"

namespace frontend {
namespace {

using csgcore::Op;
using ::testing::IsSupersetOf;
using ::testing::SizeIs;

TEST(WithFewerCorners, StaysNearTheCircle) {
  for (const double tolerance : {1e-3, 1e-2, 1.0}) {
    const Polygon circle = circle_polygon({{0, 0}, 1}, 360);
    const SimplePolygons fewer = with_fewer_corners({circle}, tolerance);
    ASSERT_THAT(fewer, SizeIs(1));
    EXPECT_THAT(circle, IsSupersetOf(fewer[0]));
    EXPECT_GE(fewer[0].size(), 24u);
    EXPECT_LE(fewer[0].size(), tolerance > 1e-3 ? 26u : 72u);
    double furthest = 0;
    visit_edges(fewer[0], [&](const Vec2& a, const Vec2& b) {
      furthest = std::max(furthest, 1 - glm::length((a + b) / 2.0));
    });
    EXPECT_LE(furthest, std::min(tolerance, 0.0087));
  }
}

TEST(WithFewerCorners, KeepsTurns) {
  // A box with a fin that is thinner than the tolerance, and an edge that goes there and back.
  const SimplePolygons box{
      {{0, 0}, {5, 0}, {5, 9}, {5.001, 9}, {5.001, 0}, {10, 0}, {10, 5}, {0, 5}}};
  EXPECT_EQ(with_fewer_corners(box, 0.1), box);
  const SimplePolygons hair{{{0, 0}, {2, 0}, {1, 0.001}, {3, 0.002}, {3, 1}}};
  EXPECT_EQ(with_fewer_corners(hair, 0.1), hair);
}

TEST(WithFewerCorners, StaysAsItIsWhereItWouldCross) {
  // Half a ring, whose outer side alone has corners to lose, is thinner than that takes away.
  Polygon ring;
  for (int i = 0; i <= 180; ++i)
    ring.push_back(Vec2(std::cos(i * kPi / 180), std::sin(i * kPi / 180)));
  for (int i = 180; i >= 0; i -= 15) {
    ring.push_back(0.9999 * Vec2(std::cos(i * kPi / 180), std::sin(i * kPi / 180)));
  }
  EXPECT_EQ(with_fewer_corners({ring}, 0.0002), SimplePolygons{ring});
  for (size_t i = 181; i < ring.size(); ++i) ring[i] *= 0.5;
  EXPECT_LT(with_fewer_corners({ring}, 0.0002).front().size(), ring.size());
}

TEST(WithFewerCorners, IsFastOnALine) {
  Polygon line{{0, 1}};
  for (int i = 0; i < 100000; ++i) line.emplace_back(i * 1e-3, 0);
  line.emplace_back(100, 1);
  EXPECT_LT(with_fewer_corners({line}, 1e-3).front().size(), 2000u);
}

TEST(United, FillsEachFigureByItsOwnRule) {
  const Polygons nested{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}};
  EXPECT_NEAR(area_of_union({outline_of(nested)}), 15, 1e-7);
  EXPECT_NEAR(area_of_union({outline_of(nested, csgcore::FillRule::kNonZero)}), 16, 1e-7);
  // A hole of one figure is filled by another.
  EXPECT_NEAR(area_of_union({outline_of(nested), rectangle(1, 1, 2, 2)}), 16, 1e-7);
}

TEST(United, TakesFiguresThatOverlap) {
  EXPECT_NEAR(area_of_union({rectangle(0, 0, 2, 2), rectangle(1, 1, 3, 3)}), 7, 1e-7);
  EXPECT_NEAR(area_of_union({Disc{Vec2(0.0), 1}}), kPi, kPi * kChordsShare);
  EXPECT_THAT(united({}).value(), SizeIs(0));
}

TEST(United, CountsCrossingsOfSpikes) {
  Polygon spikes;
  for (int i = 0; i < 3000; ++i) {
    spikes.push_back(i % 2 == 0 ? Vec2(i, i) : Vec2(1e6, i + 1e4));
  }
  spikes.emplace_back(-1, 3000);
  const std::vector<Figure> figures{outline_of(Polygons{spikes})};
  EXPECT_THAT(united(figures).value(), SizeIs(1));
}

TEST(United, KeepsTheOperandsCoordinates) {
  // None of these is on the grid. The corner (3.3, 0.1) is where edges of both cross.
  const std::vector<Figure> figures{rectangle(0, 0, 3.3, 1.1), rectangle(1, 0.1, 7.7, 2.3)};
  const SimplePolygons outline = united(figures).value();
  ASSERT_THAT(outline, SizeIs(1));
  EXPECT_THAT(outline[0], IsSupersetOf({Vec2(3.3, 0.0), Vec2(3.3, 0.1), Vec2(7.7, 0.1),
                                        Vec2(7.7, 2.3), Vec2(1, 1.1)}));
}

TEST(Combined, HasTheOperationsMeaning) {
  const SimplePolygons a{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
  const SimplePolygons b{{{1, 1}, {3, 1}, {3, 3}, {1, 3}}};
  const SimplePolygons c{{{2, 2}, {6, 2}, {6, 6}, {2, 6}}};
  const std::vector<SimplePolygons> operands{a, b, c};
  EXPECT_NEAR(area_of(combined(Op::kUnion, operands).value()), 28, 1e-7);
  EXPECT_NEAR(area_of(combined(Op::kIntersection, operands).value()), 1, 1e-7);
  EXPECT_NEAR(area_of(combined(Op::kDifference, operands).value()), 9, 1e-7);
}

TEST(MovedOutline, TreatsCorners) {
  // Corners lie on a grid of 2^-26 here: half of it along a perimeter of 24 is 2e-7.
  constexpr double kAreaSlack = 1e-6;
  const SimplePolygons square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
  const auto area = [&](double distance, CornerStyle corners) {
    return area_of(moved_outline(square, distance, corners, kChordsOfCircle));
  };
  EXPECT_NEAR(area(1, CornerStyle::kSharp), 36, kAreaSlack);
  EXPECT_NEAR(area(1, CornerStyle::kRound), 32 + kPi, kPi * kChordsShare);
  // Each corner loses a triangle whose height is √2 − 1.
  const double height = std::sqrt(2) - 1;
  EXPECT_NEAR(area(1, CornerStyle::kSquare), 36 - 4 * height * height, kAreaSlack);
  EXPECT_NEAR(area(-1, CornerStyle::kRound), 4, kAreaSlack);
  EXPECT_EQ(area(-3, CornerStyle::kSharp), 0);
  EXPECT_NEAR(area(0, CornerStyle::kSharp), 16, kAreaSlack);
}

TEST(MovedOutline, HasOpenScadsArcs) {
  // Five chords a turn make one straight cut of each corner of a square.
  const SimplePolygons square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
  EXPECT_THAT(moved_outline(square, 1, CornerStyle::kRound, 5)[0], SizeIs(8));
  EXPECT_THAT(moved_outline(square, 1, CornerStyle::kRound, 8)[0], SizeIs(12));
}

TEST(Outlines, GiveUpWhereEdgesCrossTooOften) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 1);
  Polygon scribble;
  for (int i = 0; i < 6000; ++i) scribble.emplace_back(place(random), place(random));
  const std::vector<Figure> figures{outline_of(Polygons{scribble})};
  EXPECT_FALSE(united(figures));
}

}  // namespace
}  // namespace frontend
