#include "primitives/planar_turn.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace csgcore {
namespace {

TEST(PlanarTurn, IsTheSideOfTheOrigin) {
  EXPECT_EQ(planar_turn({1, 0}, {0, 1}), 1);
  EXPECT_EQ(planar_turn({0, 1}, {1, 0}), -1);
  EXPECT_EQ(planar_turn({2, 3}, {2, 3}), 0);
}

TEST(PlanarTurn, IsExactWhereProductsRoundAlike) {
  // a × b = (1 + ε)(1 − ε) − 1 = −ε², which the rounded products hide.
  constexpr double kEpsilon = 0x1p-30;
  EXPECT_EQ(planar_turn({1 + kEpsilon, 1}, {1, 1 - kEpsilon}), -1);
  EXPECT_EQ(planar_turn({1, 1 - kEpsilon}, {1 + kEpsilon, 1}), 1);
  // The same, so small that the products are not representable.
  constexpr double kTiny = 0x1p-530;
  EXPECT_EQ(planar_turn({(1 + kEpsilon) * kTiny, kTiny}, {kTiny, (1 - kEpsilon) * kTiny}), -1);
}

TEST(PlanarTurn, MovesTheOriginOffTheLine) {
  // The origin is taken for (ε, ε²).
  EXPECT_EQ(planar_turn({-1, 0}, {1, 0}), 1);   // which lies above the x axis
  EXPECT_EQ(planar_turn({0, -1}, {0, 1}), -1);  // and right of the y axis
  EXPECT_EQ(planar_turn({-1, -1}, {1, 1}), -1);
  EXPECT_EQ(planar_turn({1, 0}, {2, 0}), 1);
}

TEST(PlanarTurn, ChangesItsSignWithTheDirection) {
  std::mt19937 random(1);
  const auto coordinate = [&] { return static_cast<double>(random() % 5) - 2; };
  for (int i = 0; i < 10'000; ++i) {
    const PlanarPoint a{coordinate(), coordinate()}, b{coordinate(), coordinate()};
    EXPECT_EQ(planar_turn(a, b), -planar_turn(b, a));
  }
}

TEST(WindingOf, CancelsOverAClosedFan) {
  // Triangles about a point cover the plane around the origin once, wherever the point lies, even
  // if it or a corner is the origin, or edges pass it.
  std::mt19937 random(2);
  const PlanarPoint around[] = {{3, 3},   {0, 3},  {-3, 3}, {-3, 0},
                                {-3, -3}, {0, -3}, {3, -3}, {3, 0}};
  for (int i = 0; i < 1000; ++i) {
    const PlanarPoint middle{static_cast<double>(random() % 5) - 2,
                             static_cast<double>(random() % 5) - 2};
    int sum = 0;
    for (size_t k = 0; k < 8; ++k) sum += winding_of(middle, around[k], around[(k + 1) % 8]);
    EXPECT_EQ(sum, 1) << middle.x << ", " << middle.y;
  }
}

}  // namespace
}  // namespace csgcore
