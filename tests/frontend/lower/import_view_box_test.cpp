// Tests the box that --viewall looks at.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "csgcore/polyhedron.hpp"
#include "lower/imported_text.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

TEST(ImporterViewBox, IsTheFacetedPrimitives) {
  // 5 fragments: the vertex nearest to -x is at 144 degrees, the one nearest to ±y at 72 degrees.
  expect_box(import_text("cylinder($fn = 0, $fa = 12, $fs = 2, h = 3, r1 = 1, r2 = 0);").view_box,
             Vec3(std::cos(M_PI * 0.8), -std::sin(M_PI * 0.4), 0), Vec3(1, std::sin(M_PI * 0.4), 3),
             1e-15);
  // 6 fragments, 3 rings, the middle one at the equator.
  expect_box(import_text("sphere($fn = 6, r = 2);").view_box,
             Vec3(-2, -std::sqrt(3), -std::sqrt(3)), Vec3(2, std::sqrt(3), std::sqrt(3)), 1e-15);
  // 8 fragments, 4 rings, none at the equator.
  const double ring = std::cos(M_PI / 8);
  expect_box(import_text("sphere($fn = 8, r = 1);").view_box, Vec3(-ring), Vec3(ring), 1e-15);
}

TEST(ImporterViewBox, OfCubesAndPolyhedra) {
  expect_box(import_text("multmatrix([[1,0,0,5]]) { cube([1, 2, 3], center = true); }").view_box,
             Vec3(4.5, -1, -1.5), Vec3(5.5, 1, 1.5), 1e-15);
  // The box is that of the local box's corners, not of the vertices.
  const double s = std::sqrt(0.5);
  expect_box(import_text("multmatrix([[0.70710678118654752,-0.70710678118654752,0,0],"
                         "[0.70710678118654752,0.70710678118654752,0,0],[0,0,1,0]]) { polyhedron(" +
                         kCorner + kFaces + "); }")
                 .view_box,
             Vec3(-4 * s, 0, 0), Vec3(3 * s, 7 * s, 5), 1e-14);
  EXPECT_EQ(import_text("sphere($fn = 100);", {.fn = 4}).view_box.max.z,
            import_text("sphere($fn = 4);").view_box.max.z);
}

TEST(ImporterViewBox, HasTheTransformedCorners) {
  expect_box(import_text("multmatrix([[0,-1,0,5],[2,0,0,0],[0,0,1,0],[0,0,0,1]]) {"
                         "cylinder($fn = 4, h = 1, r = 1); }")
                 .view_box,
             Vec3(4, -2, 0), Vec3(6, 2, 1), 1e-14);
}

TEST(ImporterViewBox, CountsPositiveLeavesAndMarkedParts) {
  const std::string small = "cylinder($fn = 4, h = 1, r = 1);";
  const std::string large = "cylinder($fn = 4, h = 1, r = 9);";
  const auto width = [](const std::string& text) { return import_text(text).view_box.max.x; };
  EXPECT_DOUBLE_EQ(width("difference() {" + small + large + "}"), 1);
  EXPECT_DOUBLE_EQ(width("intersection() {" + small + large + "}"), 9);
  // A ∖ (B ∖ C) is (A ∖ B) ∪ (A ∩ C).
  EXPECT_DOUBLE_EQ(width("difference() {" + small + "difference() {" + small + large + "} }"), 9);
  EXPECT_DOUBLE_EQ(width("%" + large + small), 9);
  EXPECT_DOUBLE_EQ(width("difference() {" + small + "#" + large + "}"), 9);
  EXPECT_DOUBLE_EQ(width("difference() {" + small + "%" + large + "}"), 9);
  // An intersection whose boxes show it to be empty is not viewed.
  EXPECT_DOUBLE_EQ(
      width("intersection() {" + small + "multmatrix([[1,0,0,20]]) {" + large + "} } " + small), 1);
  EXPECT_TRUE(import_text("").view_box.empty());
  // What is left of a leaf counts, wherever it is not subtracted.
  const std::string rest =
      "render() { difference() { cube([9, 9, 9]);"
      "multmatrix([[1,0,0,3],[0,1,0,-1],[0,0,1,-1]]) { cube([20, 20, 20]); } } }";
  // Of a box that is found by dividing one that is 9 wide.
  constexpr double kRounding = 1e-9;
  EXPECT_NEAR(width(rest), 3, kRounding);
  EXPECT_DOUBLE_EQ(width("difference() {" + small + rest + "}"), 1);
  EXPECT_NEAR(width("difference() {" + small + "#" + rest + "}"), 3, kRounding);
  EXPECT_NEAR(width("difference() {" + small + "difference() {" + small + rest + "} }"), 3,
              kRounding);
}

}  // namespace
}  // namespace frontend
