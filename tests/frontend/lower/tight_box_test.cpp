// Tests the tight box of a solid, against solids whose box is known.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "lower/leaf_boxes.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Vec3;

Box box_of(const std::string& text, const csgcore::Affine& frame = {}) {
  const csgcore::Scene scene = import_design(parse(text, "a.csg")).scene;
  csgcore::BoundsBudget budget{1 << 17};
  return tight_box(scene.primitives, scene.model, frame, budget);
}

void expect_box(const std::string& text, const Vec3& least, const Vec3& most) {
  const Box box = box_of(text);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.min[axis], least[axis], 1e-3) << text << axis;
    EXPECT_NEAR(box.max[axis], most[axis], 1e-3) << text << axis;
  }
}

TEST(TightBox, IsWhatTheOperationsLeave) {
  expect_box("sphere(r = 10, $fn = 1000);", Vec3(-10), Vec3(10));
  expect_box("intersection() { cube(size = 20, center = true); sphere(r = 13); }", Vec3(-10),
             Vec3(10));
  // The lens of two balls, whose rim is a circle.
  expect_box(
      "intersection() { multmatrix([[1,0,0,3],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) sphere(r = 5);"
      "multmatrix([[1,0,0,-3],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) sphere(r = 5); }",
      Vec3(-2, -4, -4), Vec3(2, 4, 4));
  // The cut is flush with the sides: coincident faces do not belong to the solid.
  expect_box(
      "difference() { cube(size = 20); "
      "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,10],[0,0,0,1]]) cube(size = 20); }",
      Vec3(0), Vec3(20, 20, 10));
  // A tip, and corners.
  expect_box(
      "multmatrix([[1,0,0,0.37],[0,1,0,100.61],[0,0,1,0],[0,0,0,1]])"
      " cylinder(h = 17, r1 = 3, r2 = 0, $fn = 4);",
      Vec3(-2.63, 97.61, 0), Vec3(3.37, 103.61, 17));
}

// The box stands in the frame that it was made in; what is given are that box's corners.
TEST(TightBox, IsThatOfTheFrame) {
  csgcore::Affine turned;  // by 45 degrees about z, and moved
  const double s = std::sqrt(0.5);
  turned.linear = csgcore::Mat3(Vec3(s, s, 0), Vec3(-s, s, 0), Vec3(0, 0, 1));
  turned.translation = Vec3(7, 0, 0);
  const Box box = box_of(
      "multmatrix([[0.70710678118654752,-0.70710678118654752,0,7],"
      "[0.70710678118654752,0.70710678118654752,0,0],[0,0,1,0],[0,0,0,1]])"
      " { intersection() { cube(size = 2, center = true); sphere(r = 1.2); } }",
      turned);
  EXPECT_NEAR(box.max.x, 7 + std::sqrt(2), 1e-4);
  EXPECT_NEAR(box.min.y, -std::sqrt(2), 1e-4);
  EXPECT_NEAR(box.max.z, 1, 1e-4);
}

TEST(TightBox, OfNothingIsEmpty) {
  EXPECT_TRUE(box_of("").empty());
  EXPECT_TRUE(box_of("difference() { cube(size = 5); cube(size = 5); }").empty());
}

}  // namespace
}  // namespace frontend
