#include "language/degrees.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace language {
namespace {

TEST(Degrees, AreExactAtMultiplesOf30And45) {
  EXPECT_EQ(sine_of_degrees(30), 0.5);
  EXPECT_EQ(sine_of_degrees(-390), -0.5);
  EXPECT_EQ(cosine_of_degrees(60), 0.5);
  EXPECT_EQ(cosine_of_degrees(120), -0.5);
  EXPECT_EQ(sine_of_degrees(45), std::sqrt(0.5));
  EXPECT_EQ(cosine_of_degrees(30), std::sqrt(0.75));
  EXPECT_EQ(tangent_of_degrees(45), 1);
  EXPECT_EQ(tangent_of_degrees(135), -1);
  EXPECT_EQ(tangent_of_degrees(60), std::sqrt(3.0));
}

TEST(Degrees, KeepOpenScadsSignsOfZero) {
  EXPECT_TRUE(std::signbit(sine_of_degrees(180)));
  EXPECT_FALSE(std::signbit(sine_of_degrees(0)));
  EXPECT_TRUE(std::signbit(cosine_of_degrees(270)));
  EXPECT_FALSE(std::signbit(cosine_of_degrees(90)));
  EXPECT_EQ(tangent_of_degrees(90), INFINITY);
  EXPECT_EQ(tangent_of_degrees(-90), -INFINITY);
  EXPECT_EQ(tangent_of_degrees(270), -INFINITY);
}

TEST(Degrees, AreNanBeyondAllPrecision) {
  for (const double angle : {1e19, -1e19, double{INFINITY}, double{NAN}}) {
    EXPECT_TRUE(std::isnan(sine_of_degrees(angle)));
    EXPECT_TRUE(std::isnan(cosine_of_degrees(angle)));
    EXPECT_TRUE(std::isnan(tangent_of_degrees(angle)));
  }
  EXPECT_EQ(sine_of_degrees(360e9 + 30), 0.5);
  EXPECT_EQ(tangent_of_degrees(180 * 2147483647.0 + 60), std::sqrt(3.0));
  EXPECT_NE(tangent_of_degrees(180 * 2147483648.0 + 60), std::sqrt(3.0));  // as OpenSCAD
}

TEST(Degrees, ReturnWholeAnglesOfExactValues) {
  EXPECT_EQ(arc_sine_degrees(0.5), 30);
  EXPECT_EQ(arc_cosine_degrees(0.5), 60);
  EXPECT_EQ(arc_tangent_degrees(1), 45);
  EXPECT_EQ(arc_tangent_degrees(0, -1), 180);
  EXPECT_TRUE(std::isnan(arc_sine_degrees(2)));
}

}  // namespace
}  // namespace language
