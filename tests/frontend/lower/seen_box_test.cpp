// Tests the tight box of a solid, against solids whose box is known.
#include "picture/seen_box.hpp"

#include <gtest/gtest.h>

#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "frontend/render.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Vec3;

Box box_of(const std::string& text) {
  const ImportedDesign design = import_design(parse(text, "a.csg"));
  RenderSettings settings;
  settings.renderer = RendererKind::kCpu;
  settings.measured_channels = true;
  return seen_box(design.view_box, [&](const csgcore::View& view) {
    RenderStats stats;
    return render(design.scene, view, settings, stats);
  });
}

void expect_box(const std::string& text, const Vec3& least, const Vec3& most) {
  const Box box = box_of(text);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.min[axis], least[axis], 1e-3) << text << axis;
    EXPECT_NEAR(box.max[axis], most[axis], 1e-3) << text << axis;
  }
}

TEST(SeenBox, IsWhatTheOperationsLeave) {
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

TEST(SeenBox, OfNothingIsEmpty) {
  EXPECT_TRUE(box_of("").empty());
  EXPECT_TRUE(box_of("difference() { cube(size = 5); cube(size = 5); }").empty());
}

}  // namespace
}  // namespace frontend
