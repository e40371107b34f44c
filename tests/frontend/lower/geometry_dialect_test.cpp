// Tests what a tree means by the rules of OpenSCAD's development snapshots (GeometryDialect). The
// expected values were written by OpenSCAD 2025.07.18 unless a test says otherwise.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lower/imported_text.hpp"

namespace frontend {
namespace {

using csgcore::CutFaces;
using csgcore::Vec3;
using testing::ElementsAre;

ImportOptions newer(ImportOptions options = {}) {
  options.language = language::LanguageVersion::k2026;
  return options;
}

csgcore::Box box_to_see(const std::string& text, ImportOptions options = newer()) {
  return import_text(text, std::move(options)).view_box;
}

// July 2026's; 2025.07.18 cuts the fraction off.
TEST(GeometryDialect, AFractionOfFragmentsIsRoundedUp) {
  const std::string cylinder = "cylinder($fn = 4.5, h = 1, r1 = 1, r2 = 1);";
  EXPECT_NEAR(box_to_see(cylinder).min.x, std::cos(M_PI * 0.8), 1e-15);
  EXPECT_NEAR(box_to_see(cylinder, {}).min.x, -1, 1e-15);
}

// As its documentation says: no point of a circle is further from its chord.
TEST(GeometryDialect, AChordErrorReplacesAnglesAndSizes) {
  const auto height = [](const std::string& settings) {
    // The middle of a chord faces -x where the number of fragments is odd.
    return -box_to_see("cylinder(" + settings + ", h = 1, r1 = 10, r2 = 10);").min.x;
  };
  // 7 chords are off by 10·(1 − cos(π/7)) = 0.99, 6 by 1.34.
  EXPECT_NEAR(height("$fn = 0, $fa = 12, $fs = 2, $fe = 1"), 10 * std::cos(M_PI / 7), 1e-9);
  EXPECT_NEAR(height("$fn = 5, $fa = 12, $fs = 2, $fe = 1"), 10 * std::cos(M_PI / 5), 1e-9);
}

TEST(GeometryDialect, NoSegmentsCutNoEdges) {
  const auto corners = [](const std::string& settings) {
    const ImportedDesign design = import_text(
        "linear_extrude(height = 9, twist = 90, slices = 2, " + settings + ") { square(4); }",
        newer());
    return design.scene.primitives.at(0).mesh()->vertices().size();
  };
  EXPECT_EQ(corners("segments = 0"), 3 * 4u);
  EXPECT_EQ(corners("$fn = 8, $fa = 12, $fs = 2"), 3 * 8u);
}

/// The colours of the primitives: r, g, b as one digit each; "-" without one; "!" behind a cut
/// face.
std::vector<std::string> colors(const std::string& text, ImportOptions options = newer()) {
  std::vector<std::string> result;
  for (const csgcore::Primitive& primitive :
       import_text(text, std::move(options)).scene.primitives) {
    std::string& word = result.emplace_back("-");
    if (primitive.color) {
      word.clear();
      for (const float channel : {primitive.color->r, primitive.color->g, primitive.color->b}) {
        word += channel > 0.5f ? '1' : '0';
      }
    }
    if (primitive.cut_faces == CutFaces::kAlways) word += '!';
  }
  return result;
}

const std::string kColored =
    "difference() { color([1,0,0]) { cube(); } color([0,0,1]) { sphere(); } cylinder(); }";

TEST(GeometryDialect, WhatIsEvaluatedKeepsItsColors) {
  EXPECT_THAT(colors("render() {" + kColored + "}"), ElementsAre("100", "001!", "-!"));
  EXPECT_THAT(colors("color([0,1,0]) { render() {" + kColored + "} }"),
              ElementsAre("010", "010!", "010!"));
  EXPECT_THAT(colors(kColored, newer({.picture = PictureKind::kRendered})),
              ElementsAre("100", "001!", "-!"));
  EXPECT_THAT(colors("render() {" + kColored + "}", {}), ElementsAre("-", "-", "-"));
}

TEST(GeometryDialect, AllThatIsSubtractedHasCutFaces) {
  const std::string nested = "difference() { cube(); difference() { sphere(); cylinder(); } }";
  EXPECT_THAT(colors("render() {" + nested + "}"), ElementsAre("-", "-!", "-!"));
  EXPECT_THAT(colors(nested, newer({.picture = PictureKind::kRendered})),
              ElementsAre("-", "-!", "-!"));
  // In the preview a leaf that is subtracted is cut as a whole.
  EXPECT_THAT(colors("difference() { cube(); render() {" + nested + "} }"),
              ElementsAre("-", "-!", "-!", "-!"));
  EXPECT_THAT(colors("render() { difference() { render() {" + nested + "} cube(); } }"),
              ElementsAre("-", "-!", "-!", "-!"));
  // What an extrusion is made of does not show.
  EXPECT_THAT(colors("render() { difference() { cube(); linear_extrude(height = 1) { difference() {"
                     "square(3); circle(1); } } } }"),
              ElementsAre("-", "-!", "-!"));
}

TEST(GeometryDialect, AResizedSolidKeepsItsCutFaces) {
  EXPECT_THAT(colors("resize([3,0,0]) { difference() { cube(2); cube(1); } }"),
              ElementsAre("-", "-!"));
}

TEST(GeometryDialect, AResizedSolidKeepsItsColors) {
  EXPECT_THAT(colors("resize([3,0,0]) {" + kColored + "}"), ElementsAre("100", "001!", "-!"));
  EXPECT_THAT(colors("color([0,1,0]) { resize([3,0,0]) {" + kColored + "} }"),
              ElementsAre("010", "010!", "010!"));
  EXPECT_THAT(
      colors("resize([3,0,0]) {" + kColored + "}", newer({.picture = PictureKind::kRendered})),
      ElementsAre("100", "001!", "-!"));
  EXPECT_THAT(colors("resize([3,0,0]) {" + kColored + "}", {}), ElementsAre("-", "-", "-"));
  EXPECT_THAT(colors("resize([3,0,0]) { color([0,1,0]) { color([1,0,0]) { cube(); } } }"),
              ElementsAre("010"));
}

TEST(GeometryDialect, HullsAndSumsHaveNoColorsOfTheirParts) {
  const std::string parts = "color([1,0,0]) { cube(); } color([0,0,1]) { cube(2); }";
  EXPECT_THAT(colors("resize([3,0,0]) { hull() {" + parts + "} }"), ElementsAre("-"));
  EXPECT_THAT(colors("hull() { color([1,0,0]) { cube(); } }"), ElementsAre("-"));
  EXPECT_THAT(colors("minkowski() {" + parts + "}"), ElementsAre("-"));
  EXPECT_THAT(colors("minkowski() { color([1,0,0]) { cube(); } }"), ElementsAre("100"));
  EXPECT_THAT(colors("resize([3,0,0]) { color([0,1,0]) { hull() {" + parts + "} } }"),
              ElementsAre("010"));
}

TEST(GeometryDialect, ALeafIsTranslucentWherePartOfItIs) {
  const csgcore::Scene scene =
      import_text("render() { union() { cube(); color([1,0,0,0.5]) { sphere(); } } }", newer())
          .scene;
  EXPECT_FALSE(scene.layers.empty());
}

// By the golden pictures of July 2026.
TEST(GeometryDialect, TheCameraSeesIntersections) {
  expect_box(box_to_see("intersection() { cube(10); multmatrix([[1,0,0,5]]) { cube(10); } }"),
             Vec3(5, 0, 0), Vec3(10), 0);
  // Each product by itself, without those that are empty.
  expect_box(box_to_see("intersection() { cube(10); union() { multmatrix([[1,0,0,8]]) { cube(10); }"
                        "multmatrix([[1,0,0,50]]) { cube(10); } } }"),
             Vec3(8, 0, 0), Vec3(10), 0);
  expect_box(box_to_see("difference() { cube(10); multmatrix([[1,0,0,5]]) { cube(10); } }"),
             Vec3(0), Vec3(10), 0);
  expect_box(
      box_to_see("cube(1); intersection() { cube(10); multmatrix([[1,0,0,5]]) { cube(10); } }", {}),
      Vec3(0), Vec3(15, 10, 10), 0);
}

TEST(GeometryDialect, ThousandsOfProductsAreSeen) {
  std::string text = "intersection() { union() {";
  for (int i = 0; i < 3000; ++i) {
    text += "multmatrix([[1,0,0," + std::to_string(2 * i) + "]]) { cube(1); }";
  }
  text += "} cube([10000, 1, 1]); }";
  expect_box(box_to_see(text), Vec3(0), Vec3(5999, 1, 1), 0);
}

TEST(GeometryDialect, PlaneFiguresAreOneThickToTheCamera) {
  expect_box(box_to_see("square(4);"), Vec3(0, 0, -0.5), Vec3(4, 4, 0.5), 0);
  expect_box(box_to_see("square(4);", {}), Vec3(0), Vec3(4, 4, 0), 0);
  // Seen from the side: the plane's z axis lies along x.
  expect_box(box_to_see("multmatrix([[0,0,1,0],[0,1,0,0],[-1,0,0,0]]) { square(4); }"),
             Vec3(-0.5, 0, -4), Vec3(0.5, 4, 0), 0);
  expect_box(box_to_see("difference() { square(4); circle(r = 1, $fn = 4); }"), Vec3(0, 0, -0.5),
             Vec3(4, 4, 0.5), 0);
}

}  // namespace
}  // namespace frontend
