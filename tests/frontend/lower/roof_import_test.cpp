// Tests what becomes of roof().
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lower/imported_text.hpp"

namespace frontend {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// An L whose reflex corner is (10, 10).
const std::string kAngle =
    "polygon([[0, 0], [20, 0], [20, 10], [10, 10], [10, 20], [0, 20]], [[0, 1, 2, 3, 4, 5]]);";

/// Returns the height of a design over a point, of at most 20.
double height_of(const Inside& inside, double x, double y) {
  double low = 0, high = 20;
  if (!inside(x, y, 1e-6)) return 0;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (inside(x, y, middle) ? low : high) = middle;
  }
  return low;
}

TEST(RoofImport, RisesAtUnitSlope) {
  const Inside straight("roof(method = \"straight\") {" + kAngle + "}");
  const Inside voronoi("roof(method = \"voronoi\") {" + kAngle + "}");
  EXPECT_THAT(straight.design().warnings, IsEmpty());
  EXPECT_THAT(voronoi.design().warnings, IsEmpty());
  EXPECT_NEAR(height_of(straight, 15, 4), 4, 1e-9);
  EXPECT_NEAR(height_of(straight, 7, 7), 3, 1e-9);
  EXPECT_NEAR(height_of(voronoi, 7, 7), std::hypot(3, 3), 2e-3);
  EXPECT_FALSE(straight(15, 4, -1e-6));
  EXPECT_FALSE(straight(15, 15, 1e-6));
}

TEST(RoofImport, IsVoronoisByDefault) {
  EXPECT_NEAR(height_of(Inside("roof() {" + kAngle + "}"), 7, 7), std::hypot(3, 3), 2e-3);
  EXPECT_THAT(warning_of("roof(method = \"flat\") {" + kAngle + "}"),
              HasSubstr("roof: method is \"flat\", and counts as \"voronoi\""));
}

TEST(RoofImport, HasFacetsIfTheyAreKept) {
  ImportOptions options;
  options.facets = Facets::kNone;
  const Inside round("roof($fn = 8) {" + kAngle + "}", options);
  options.facets = Facets::kAll;
  const Inside faceted("roof($fn = 8) {" + kAngle + "}", options);
  // Half way between the two planes of a cone that a turn by 45° at most leaves.
  EXPECT_NEAR(height_of(round, 7, 7), std::hypot(3, 3), 2e-3);
  EXPECT_NEAR(height_of(faceted, 7, 7), std::hypot(3, 3) * std::cos(std::atan(1) / 3), 1e-9);
}

TEST(RoofImport, IsAConeOverADisc) {
  const Inside cone(
      "multmatrix([[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) "
      "{ roof() { circle(r = 5, $fn = 0); } }");
  EXPECT_NEAR(height_of(cone, 2 + 1.2, 1.6), 3, 1e-9);
  EXPECT_THAT(cone.design().scene.primitives, testing::SizeIs(1));
}

TEST(RoofImport, TakesTheUnionOfItsFigures) {
  const Inside roof(
      "roof(method = \"straight\") { square([10, 4]); square([4, 10]); sphere(50); }");
  EXPECT_NEAR(height_of(roof, 2, 2), 2, 1e-9);
  EXPECT_NEAR(height_of(roof, 3, 1), 1, 1e-9);
  EXPECT_THAT(warning_of("roof() { square(1); sphere(50); }"),
              HasSubstr("Ignoring 3D child object for 2D operation"));
  EXPECT_EQ(model_of("roof() { circle(0); } roof(); sphere();"), "1");
}

TEST(RoofImport, IsASolidLikeOthers) {
  const std::string pyramid = "roof() { square(10); }";
  const Inside cut("difference() { cube(10); " + pyramid + " }");
  EXPECT_FALSE(cut(5, 5, 4.9));
  EXPECT_TRUE(cut(5, 5, 5.1));
  const Inside hull("hull() { " + pyramid +
                    " multmatrix([[1, 0, 0, 20], [0, 1, 0, 0], "
                    "[0, 0, 1, 0], [0, 0, 0, 1]]) { " +
                    pyramid + " } }");
  EXPECT_NEAR(height_of(hull, 15, 5), 5, 1e-9);
  EXPECT_NEAR(height_of(hull, 15, 1), 1, 1e-9);
  const Inside sum("minkowski() { " + pyramid + " cube(1); }");
  EXPECT_NEAR(height_of(sum, 5.5, 5.5), 6, 1e-9);
}

}  // namespace
}  // namespace frontend
