// Tests hull, minkowski and resize of solids: what is inside of them, and what they tell.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <string>

#include "lower/imported_text.hpp"

namespace frontend {
namespace {

using csgcore::Shape;
using csgcore::Vec3;
using ::testing::Each;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Optional;
using ::testing::SizeIs;

std::string at(double x, double y, double z, const std::string& children) {
  return "multmatrix([[1,0,0," + std::to_string(x) + "],[0,1,0," + std::to_string(y) + "],[0,0,1," +
         std::to_string(z) + "],[0,0,0,1]]) {" + children + "}";
}

std::string scaled(double x, double y, double z, const std::string& children) {
  return "multmatrix([[" + std::to_string(x) + ",0,0,0],[0," + std::to_string(y) + ",0,0],[0,0," +
         std::to_string(z) + ",0],[0,0,0,1]]) {" + children + "}";
}

size_t count_of(const ImportedDesign& design, Shape shape) {
  return static_cast<size_t>(
      std::count_if(design.scene.primitives.begin(), design.scene.primitives.end(),
                    [shape](const csgcore::Primitive& p) { return p.shape() == shape; }));
}

// --- hull -----------------------------------------------------------------------------------

/// Each hull took a copy of all that the one within it has: 10,000 took 9 s and more.
TEST(SolidHull, OfHullsTakesAsLongAsTheyAre) {
  constexpr int kHulls = 4000;
  std::string chain, moved;
  const std::string matrix = "multmatrix([[1,0,0,0.01],[0,1,0,0],[0,0,1,0],[0,0,0,1]]){";
  for (int i = 0; i < kHulls; ++i) {
    chain += "hull(){" + at(i % 100, i / 100, 0, "cube(1);");
    moved += "hull(){" + matrix + "cube(1);";
  }
  chain += std::string(kHulls, '}');
  moved += std::string(2 * kHulls, '}');
  const std::clock_t start = std::clock();
  const Inside inside(chain), inside_moved(moved);
  // A multiple of what it takes; it took some five seconds.
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 3);
  for (const double place : {0.1, 20.0, 39.9}) {
    EXPECT_TRUE(inside(place, place, 0.5)) << place;
    EXPECT_FALSE(inside(place, place, 1.1)) << place;
    EXPECT_TRUE(inside_moved(place + 0.1, 0.5, 0.5)) << place;
  }
  EXPECT_FALSE(inside_moved(41.1, 0.5, 0.5));
}

TEST(SolidHull, OfTwoBallsIsAFrustumBetweenThem) {
  const Inside inside("hull() { sphere(2); " + at(10, 0, 0, "sphere(1);") + "}");
  EXPECT_EQ(count_of(inside.design(), Shape::kSphere), 2u);
  EXPECT_EQ(count_of(inside.design(), Shape::kFrustum), 1u);
  const double slope = 0.1;  // the sine of the side's angle
  const double side = (2 - slope * 5) / std::sqrt(1 - slope * slope);  // at x = 5
  EXPECT_TRUE(inside(5, side - 1e-9, 0));
  EXPECT_FALSE(inside(5, side + 1e-9, 0));
  EXPECT_TRUE(inside(10.99, 0, 0));
}

TEST(SolidHull, IsOneLeafWithoutTheColorsInside) {
  const ImportedDesign design = import_text(
      "color([0,0,1]) { hull() { color([1,0,0]) { sphere(2); } " + at(5, 0, 0, "cube(1);") + "} }");
  EXPECT_EQ(design.leaves, 1u);
  EXPECT_EQ(design.compound_leaves, 1u);
  for (const csgcore::Primitive& primitive : design.scene.primitives) {
    EXPECT_EQ(primitive.color, (csgcore::Color{0, 0, 1, 1}));
    EXPECT_EQ(primitive.id, 0u);
  }
}

TEST(SolidHull, TakesMatricesBothInsideAndAround) {
  const Inside inside(
      scaled(1, 1, 2, "hull() {" + scaled(2, 1, 1, "sphere(1);") + at(0, 0, 4, "cube(1);") + "}"));
  EXPECT_TRUE(inside(1.99, 0, 0));
  EXPECT_FALSE(inside(2.01, 0, 0));
  EXPECT_TRUE(inside(0.5, 0.5, 9.9));
  EXPECT_FALSE(inside(0.5, 0.5, 10.1));
}

TEST(SolidHull, OfAnEllipsoidIsThatEllipsoid) {
  const ImportedDesign design = import_text("hull() {" + scaled(3, 2, 1, "sphere(1);") + "}");
  EXPECT_THAT(design.scene.primitives, SizeIs(1));
  EXPECT_EQ(count_of(design, Shape::kSphere), 1u);
}

TEST(SolidHull, NestsAndIgnoresWhatIsEmpty) {
  const std::string inner = "hull() { sphere(1); " + at(4, 0, 0, "sphere(1);") + "}";
  const Inside inside("hull() {" + inner + at(0, 4, 0, "sphere(1);") + "sphere(0); cube(0); }");
  EXPECT_TRUE(inside(1.5, 1.5, 0.99));
  EXPECT_EQ(model_of("hull() { sphere(0); cube(0); }"), "-");
  EXPECT_EQ(model_of("hull(); cube(1);"), "0");
}

TEST(SolidHull, OfExtrusionsTakesTheirArcs) {
  const Inside inside("hull() { linear_extrude(height = 2) { circle(r = 3); }" +
                      at(0, 0, 6, "linear_extrude(height = 1) { circle(r = 3); }") + "}");
  EXPECT_TRUE(inside(2.12, 2.12, 4));
  EXPECT_FALSE(inside(2.13, 2.13, 4));
  EXPECT_EQ(inside.design().scene.primitives.size(), count_of(inside.design(), Shape::kFrustum));
  const Inside torus("hull() { rotate_extrude() {" + at(5, 0, 0, "circle(r = 1);") + "} }");
  EXPECT_TRUE(torus(0, 0, 0.99));
  EXPECT_TRUE(torus(0, 5.99, 0));
  EXPECT_FALSE(torus(0, 5.9, 0.9));
}

TEST(SolidHull, OfExtrusionsThatTurnOrLeanTakesTheirCorners) {
  const std::string bar = "square([8, 1], center = true);";
  const Inside turned("hull() { linear_extrude(height = 4, twist = 90) {" + bar + "} }");
  EXPECT_TRUE(turned(3.9, 0, 0.01));
  EXPECT_TRUE(turned(0, -3.9, 3.99));
  EXPECT_TRUE(turned(2, 1.9, 2)) << "between the corners of both ends";
  EXPECT_FALSE(turned(3.9, 0.6, 3.99));
  EXPECT_FALSE(turned(0, 0, 4.01));
  EXPECT_EQ(turned.design().faceted_leaves, 1u);
  const Inside wide(
      "hull() { linear_extrude(height = 4, scale = [0, 2]) { square(2, center = true); } }");
  EXPECT_TRUE(wide(0, 1.99, 3.99));
  EXPECT_FALSE(wide(0.1, 0, 3.9));
  const Inside leaning("hull() { linear_extrude(v = [3, 0, 4], scale = 0.5) { circle(r = 1); } }");
  EXPECT_TRUE(leaning(3.49, 0, 3.999));
  EXPECT_FALSE(leaning(3.51, 0, 3.999));
  EXPECT_EQ(leaning.design().faceted_leaves, 0u) << "it is a frustum";
}

TEST(SolidHull, OfAPartialTurnEndsWhereItEnds) {
  const std::string turn = "rotate_extrude(angle = 90) {" + at(5, 0, 0, "circle(r = 1);") + "}";
  const Inside inside("hull() {" + turn + "}");
  EXPECT_TRUE(inside(3, 3, 0));
  EXPECT_TRUE(inside(4.2, 4.2, 0));
  EXPECT_FALSE(inside(4.3, 4.3, 0));
  EXPECT_FALSE(inside(5, -0.01, 0));
  EXPECT_EQ(inside.design().faceted_leaves, 1u);
  EXPECT_THAT(warnings_of("hull() { rotate_extrude() { square(2, center = true); } cube(1); }"),
              testing::ElementsAre(HasSubstr("same X coordinate sign (range is -1.00 -> 1.00)")));
}

TEST(SolidHull, WithFacetsHasTheRingsOfRevolutions) {
  ImportOptions options;
  options.facets = Facets::kAll;
  const Inside inside("hull() { rotate_extrude($fn = 4) {" + at(5, 0, 0, "square(1);") + "} }",
                      options);
  EXPECT_TRUE(inside(5.99, 0, 0.5));
  EXPECT_FALSE(inside(3.1, 3.1, 0.5));
}

TEST(SolidHull, WithFacetsIsThePolyhedronOfOpenScadsCorners) {
  ImportOptions options;
  options.facets = Facets::kAll;
  const ImportedDesign design = import_text(
      "hull() { cylinder($fn = 5, h = 1, r1 = 2, r2 = 2); " + at(0, 0, 3, "cube(1);") + "}",
      options);
  EXPECT_THAT(design.scene.primitives, SizeIs(1));
  EXPECT_EQ(count_of(design, Shape::kPolyhedron), 1u);
  EXPECT_EQ(import_text("hull() { sphere($fn = 6, r = 1); cube(3); }").scene.primitives.size(), 1u)
      << "few facets are kept by default";
}

TEST(SolidHull, OfPointsInAPlaneIsASheet) {
  const ImportedDesign design = import_text("hull() {" + scaled(1, 1, 0, "cube(4);") + "}");
  ASSERT_THAT(design.scene.primitives, SizeIs(1));
  EXPECT_TRUE(csgcore::is_valid(design.scene.primitives.front()));
  expect_box(design.view_box, Vec3(0, 0, 0), Vec3(4, 4, 0), 0);
  EXPECT_EQ(model_of("hull() {" + scaled(1, 0, 0, "cube(4);") + "}"), "-");
}

TEST(SolidHull, HasTheBoxOfOpenScadsCorners) {
  // Five corners of a circle: the outermost one to the left is at cos(144°).
  const ImportedDesign design =
      import_text("hull() { cylinder(h = 2, r = 1, $fn = 5); }", ImportOptions{});
  expect_box(design.view_box, Vec3(std::cos(std::acos(-1) * 0.8), -0.9510565162951535, 0),
             Vec3(1, 0.9510565162951535, 2), 1e-15);
}

TEST(SolidHull, OfExtremeSizesDoesNoHarm) {
  EXPECT_THAT(
      import_text("hull() { sphere(1e-9); " + at(1e9, 0, 0, "sphere(1e9);") + "}").scene.primitives,
      Not(IsEmpty()));
  EXPECT_THAT(import_text("hull() { sphere(1e200); cube(1e-200); } cube(1);").scene.primitives,
              Not(IsEmpty()));
  EXPECT_THAT(import_text("hull() { multmatrix([[1e300,0,0,1e300],[0,1e300,0,0],[0,0,1e300,0]]) {"
                          "sphere(1e300); } cube(1); } cube(1);")
                  .scene.primitives,
              SizeIs(1));
}

TEST(SolidHull, CutsConvexSolidsInside) {
  // The hull of a cube without one half of it.
  const Inside inside("hull() { difference() { cube(4); " + at(2, -1, -1, "cube(9);") + "} }");
  EXPECT_TRUE(inside(1.9, 3.9, 3.9));
  EXPECT_FALSE(inside(2.1, 2, 2));
  EXPECT_EQ(model_of("hull() { intersection() { cube(1); " + at(5, 0, 0, "cube(1);") + "} }"), "-");
}

TEST(SolidHull, OfADifferenceWithWhatIsFlatIsThatOfTheSolid) {
  // A square that leans, and whose box meets the second cube only.
  const std::string flat = "multmatrix([[1,0,0,5],[0,1,0,0],[1,0,0,0],[0,0,0,1]]) { cube(1); }";
  const std::string cubes = "union() { cube(1); " + at(5, 0, 0, "cube(1);") + "}";
  const Inside inside("hull() { difference() { " + cubes + flat + "} }");
  EXPECT_TRUE(inside(0.5, 0.5, 0.5));
  EXPECT_TRUE(inside(3, 0.5, 0.5));
  EXPECT_TRUE(inside(5.5, 0.5, 0.5));
  EXPECT_EQ(model_of("hull() { intersection() { " + cubes + flat + "} }"), "-");
}

TEST(SolidHull, OfWhatOperationsLeaveOfRoundSolids) {
  // A ball without its upper part, from z = 1 on.
  const Inside cap("hull() { difference() { sphere(4); " + at(-5, -5, 1, "cube(10);") + "} }");
  EXPECT_TRUE(cap(0, 0, 0.999));
  EXPECT_FALSE(cap(0, 0, 1.001));
  EXPECT_TRUE(cap(0, 0, -3.99));
  EXPECT_TRUE(cap(3.98, 0, -0.1));
  EXPECT_FALSE(cap(4.001, 0, 0));
  EXPECT_EQ(cap.design().faceted_leaves, 1u);
  // Half of a torus, whose hull has no hole.
  const Inside half("hull() { intersection() { rotate_extrude() {" + at(5, 0, 0, "circle(r = 1);") +
                    "} " + at(0, -9, -9, "cube(18);") + "} }");
  EXPECT_TRUE(half(0.01, 5.9, 0));
  EXPECT_TRUE(half(1, 0, 0.9));
  EXPECT_FALSE(half(-0.01, 3, 0));
}

TEST(SolidHull, OfOperationsThatLeaveASolidAsItIsKeepsItExact) {
  const Inside inside("hull() { difference() { sphere(4); " + at(9, 0, 0, "sphere(1);") + "} }");
  EXPECT_THAT(inside.design().scene.primitives, SizeIs(1));
  EXPECT_EQ(count_of(inside.design(), Shape::kSphere), 1u);
}

TEST(SolidHull, OfOperationsWithinOperations) {
  const Inside inside("hull() { difference() { union() { cube(4); " + at(3, 0, 0, "cube(4);") +
                      "} difference() { " + at(-1, -1, 2, "cube(20);") + at(6, -2, 1, "cube(20);") +
                      "} } }");
  EXPECT_TRUE(inside(6.5, 3.9, 3.9)) << "a cutter has a hole there";
  EXPECT_FALSE(inside(0.1, 2, 3)) << "below the line from there to the corner at z = 2";
  EXPECT_TRUE(inside(0.1, 2, 1.9));
}

TEST(SolidHull, IsLeftOutWhereAnOpenMeshTakesPart) {
  EXPECT_THAT(warnings_of("hull() { difference() { cube(4); polyhedron(" + kCorner +
                          "faces = [[0,1,2],[0,3,1],[0,2,3]]); } }"),
              testing::Contains(HasSubstr(
                  "a.csg:1:1: warning: hull is left out (it needs the outcome of a difference "
                  "or an intersection with a mesh that is not closed)")));
}

TEST(SolidHull, MayStandInOperationsAndModifiers) {
  const Inside inside("difference() { cube(10); hull() { sphere(2); " + at(4, 0, 0, "sphere(2);") +
                      "} } *hull() { cube(99); }");
  EXPECT_FALSE(inside(3, 1, 1));
  EXPECT_TRUE(inside(3, 3, 3));
  EXPECT_EQ(layers_of(import_text("cube(1); %hull() { cube(2); sphere(1); }").scene,
                      csgcore::Layer::Kind::kBackground)
                .empty(),
            false);
}

TEST(SolidHull, ShowsThePartsInsideThatHaveModifiers) {
  const ImportedDesign design =
      import_text("hull() { cube(1); group() {" + at(5, 0, 0, "%sphere(1); #cube(2);") +
                  "} *cube(9); }"
                  "linear_extrude(height = 1) { square(1); %square(2); }");
  EXPECT_EQ(layers_of(design.scene, csgcore::Layer::Kind::kBackground), "1");
  EXPECT_EQ(layers_of(design.scene, csgcore::Layer::Kind::kHighlight), "2");
  EXPECT_EQ(design.scene.primitives[1].local_to_world.translation, Vec3(5, 0, 0));
  EXPECT_THAT(design.scene.primitives, SizeIs(4)) << "the hull, its parts, and the extrusion";
  EXPECT_THAT(import_text("render() { hull() { cube(1); %sphere(1); } }").scene.primitives,
              SizeIs(1));
}

TEST(SolidHull, OverlaysOnlyAFewHighlightsInsideOneAnother) {
  constexpr int kLevels = 200;
  std::string text;
  for (int i = 0; i < kLevels; ++i) text += "hull() { #";
  text += "sphere();";
  text.append(kLevels, '}');
  EXPECT_THAT(import_text(text).scene.primitives, SizeIs(9)) << "the hull, and eight over it";
}

TEST(SolidHull, ShowsThePartsInsideInTheirOwnColors) {
  const ImportedDesign design = import_text(
      "hull() { cube(1); color([1,0,0]) { %cube(2); } %group() { color([0,0,1]) { cube(3); } "
      "cube(4); } }");
  EXPECT_EQ(layers_of(design.scene, csgcore::Layer::Kind::kBackground), "(1+2+3)");
  ASSERT_THAT(design.scene.primitives, SizeIs(4));
  EXPECT_EQ(design.scene.primitives[1].color, (csgcore::Color{1, 0, 0, 1}));
  EXPECT_EQ(design.scene.primitives[2].color, (csgcore::Color{0, 0, 1, 1}));
  EXPECT_EQ(design.scene.primitives[3].color, import_text("%cube(1);").scene.primitives[0].color);
}

TEST(SolidHull, KeepsTheOrderOfTheFile) {
  const ImportedDesign design =
      import_text("cube(1); hull() { cube(2); } cube(3); hull() { cube(4); cube(5); } cube(6);");
  std::vector<uint32_t> ids;
  for (const csgcore::Primitive& primitive : design.scene.primitives) ids.push_back(primitive.id);
  EXPECT_THAT(ids, testing::ElementsAre(0, 1, 2, 3, 5));
}

// --- minkowski ------------------------------------------------------------------------------

TEST(SolidMinkowski, RoundsABox) {
  const Inside inside("minkowski() { cube(4); sphere(1); }");
  EXPECT_TRUE(inside(-0.99, 2, 2));
  EXPECT_FALSE(inside(-1.01, 2, 2));
  const double corner = 1 / std::sqrt(3.0);
  EXPECT_TRUE(inside(4 + corner - 1e-9, 4 + corner - 1e-9, 4 + corner - 1e-9));
  EXPECT_FALSE(inside(4 + corner + 1e-9, 4 + corner + 1e-9, 4 + corner + 1e-9));
}

TEST(SolidMinkowski, OfACylinderAndABallIsRevolved) {
  const ImportedDesign design = import_text("minkowski() { cylinder(h = 4, r = 3); sphere(1); }");
  EXPECT_THAT(design.scene.primitives, SizeIs(1));
  EXPECT_EQ(count_of(design, Shape::kRevolution), 1u);
}

TEST(SolidMinkowski, DistributesOverUnions) {
  const Inside inside("minkowski() { union() { cube(1); " + at(9, 0, 0, "cube(1);") +
                      "} cylinder(h = 1, r = 1); }");
  EXPECT_TRUE(inside(-0.5, 0.5, 0.5));
  EXPECT_TRUE(inside(9.5, 1.9, 1.9));
  EXPECT_FALSE(inside(5, 0.5, 0.5));
}

TEST(SolidMinkowski, FoldsAndIgnoresWhatIsEmpty) {
  const Inside inside("minkowski() { sphere(0); cube(1); cube(2); cube(3); }");
  EXPECT_TRUE(inside(5.9, 5.9, 5.9));
  EXPECT_FALSE(inside(6.1, 1, 1));
  EXPECT_EQ(count_of(inside.design(), Shape::kPolyhedron), 1u);
  EXPECT_EQ(model_of("minkowski() { cube(3); }"), "0") << "one child stays as it is";
  EXPECT_EQ(model_of("minkowski() {" + scaled(0, 0, 1, "cube(1);") + scaled(0, 1, 0, "cube(1);") +
                     "cube(1); }"),
            "-")
      << "a flat sum is empty";
}

TEST(SolidMinkowski, OfAProfileThatIsNotConvexGoesAlongItsWalls) {
  const Inside inside("minkowski() { linear_extrude(height = 2) { difference() { square(10); " +
                      at(3, 3, 0, "square(4);") + "} } sphere(1); }");
  EXPECT_TRUE(inside(1, 1, 2.99));
  EXPECT_TRUE(inside(3.9, 5, 1));
  EXPECT_FALSE(inside(4.1, 5, 1)) << "in the hole";
  EXPECT_FALSE(inside(-0.8, 5, 2.8)) << "beyond the rounded edge";
  EXPECT_TRUE(inside(-0.6, 5, 2.6));
}

TEST(SolidMinkowski, OfAProfileThatIsNotConvexTakesWhatLeans) {
  const std::string bar = "multmatrix([[1,0,3,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(1); }";
  const Inside inside("minkowski() { linear_extrude(height = 2) { difference() { square(20);" +
                      at(9, 9, 0, "square(6);") + "} }" + bar + "}");
  EXPECT_TRUE(inside(0.1, 5, 0.01));
  EXPECT_FALSE(inside(0.1, 5, 2.99));
  EXPECT_TRUE(inside(3.1, 5, 2.99));
  EXPECT_TRUE(inside(5, 5, 1.5));
  EXPECT_TRUE(inside(23.9, 5, 2.99));
  EXPECT_FALSE(inside(14.5, 12, 1.5)) << "in the hole";
}

TEST(SolidMinkowski, OfAMeshGoesAlongItsFaces) {
  // Two tetrahedra in one mesh, far from each other.
  const Inside inside(
      "minkowski() { polyhedron(points = [[0,0,0],[4,0,0],[0,4,0],[0,0,4],"
      "[20,0,0],[24,0,0],[20,4,0],[20,0,4]], faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,2],"
      "[4,5,6],[4,7,5],[4,6,7],[5,7,6]]); cube(1, center = true); }");
  EXPECT_TRUE(inside(1, 1, 1));
  EXPECT_TRUE(inside(-0.4, 1, 1));
  EXPECT_TRUE(inside(21, 1, 1));
  EXPECT_FALSE(inside(12, 0, 0));
  EXPECT_FALSE(inside(-0.6, 1, 1));
}

TEST(SolidMinkowski, OfATurningExtrusionGoesAlongItsFaces) {
  const Inside inside(
      "minkowski() { linear_extrude(height = 4, twist = 45) { difference() {"
      "square(8, center = true); square(4, center = true); } } cube(1, center = true); }");
  EXPECT_TRUE(inside(3, 0, 4.4));
  EXPECT_FALSE(inside(0, 0, 4.4)) << "in the hole, over which the ends have no faces";
  EXPECT_FALSE(inside(0, 0, 2));
  EXPECT_TRUE(inside(4.4, 0, 0));
}

TEST(SolidMinkowski, RoundsWhatOperationsLeave) {
  // A block with a hole of 4 × 4, and a ball.
  const Inside inside("minkowski() { difference() { cube([10, 10, 4]); " +
                      at(3, 3, -1, "cube([4, 4, 6]);") + "} sphere(1); }");
  EXPECT_TRUE(inside(-0.99, 5, 2));
  EXPECT_FALSE(inside(-1.01, 5, 2));
  EXPECT_TRUE(inside(3.99, 5, 2));
  EXPECT_FALSE(inside(4.01, 5, 2)) << "in the hole";
  EXPECT_FALSE(inside(3.8, 5, 4.8)) << "beyond the rounded edge of the hole";
  EXPECT_TRUE(inside(3.6, 5, 4.6));
  EXPECT_TRUE(inside(4 - 0.3, 4 - 0.3, 2)) << "an inner corner stays sharp";
  const double corner = 1 / std::sqrt(3.0);
  EXPECT_TRUE(inside(10 + corner - 1e-6, 10 + corner - 1e-6, 4 + corner - 1e-6));
  EXPECT_FALSE(inside(10 + corner + 1e-6, 10 + corner + 1e-6, 4 + corner + 1e-6));
}

TEST(SolidMinkowski, OfASolidThatIsNotConvexAddsItsConvexPieces) {
  // Walls of octagonal holes are not quite planes: cuts leave ledges.
  std::string holes, circles;
  for (int i = 0; i < 4; ++i) {
    const double x = 4 + 8 * (i % 2), y = 4 + 8 * (i / 2);
    holes += at(x, y, -1, "cylinder(h = 6, r1 = 2, r2 = 2, $fn = 8);");
    circles += at(x, y, 0, "circle(r = 2, $fn = 8);");
  }
  const std::string body = "cylinder(h = 1, r1 = 1, r2 = 0.5, $fn = 6);";
  const std::string sum =
      "minkowski() { difference() { cube([16, 16, 4]); " + holes + "}" + body + "}";
  EXPECT_LE(import_text(sum).scene.primitives.size(), 40) << "there are 140 triangles";
  const Inside inside(sum);
  const Inside expected("minkowski() { linear_extrude(height = 4) { difference() { square(16);" +
                        circles + "} }" + body + "}");
  for (double x = -1.45; x < 18; x += 0.25) {
    for (double y = -1.37; y < 10; y += 0.25) {
      for (const double z : {0.2, 2.1, 4.3}) {
        ASSERT_EQ(inside(x, y, z), expected(x, y, z)) << x << ", " << y << ", " << z;
      }
    }
  }
}

TEST(SolidMinkowski, TakesFacesWhereCutsLeaveAsManyEdgesThatTurnInwards) {
  // Cuts along the narrow faces of this twist leave slivers at the same edge, again and again: they
  // took minutes.
  const Inside inside(
      "minkowski() { linear_extrude(height = 2, twist = 60, scale = 0.5, $fn = 3) {"
      "polygon([[0, 0], [4, 1], [2, 0]]); } cube(1, center = true); }");
  EXPECT_TRUE(inside(4.45, 1.45, -0.45));
  EXPECT_FALSE(inside(4.55, 1.45, -0.45));
  EXPECT_TRUE(inside(2, -0.45, 0));
  EXPECT_TRUE(inside(0, 0, 2.45));
  EXPECT_FALSE(inside(0, 0, 2.55));
}

TEST(SolidMinkowski, OfARoundSolidThatIsNotConvexTakesItsFacets) {
  const std::string ring = "rotate_extrude() {" + at(5, 0, 0, "circle(r = 1);") + "}";
  const Inside inside("minkowski() {" + ring + "cube(2, center = true); }");
  EXPECT_TRUE(inside(6.98, 0, 0.9));
  EXPECT_FALSE(inside(7.01, 0, 0));
  EXPECT_FALSE(inside(0, 0, 0)) << "in the hole";
  EXPECT_FALSE(inside(2.8, 0, 0));
  EXPECT_TRUE(inside(2.95, 0, 0));
}

TEST(SolidMinkowski, OfATaperedProfileTakesItsFacets) {
  const Inside inside(
      "minkowski() { linear_extrude(height = 4, scale = 0.5) { difference() {"
      "square(8, center = true); square(4, center = true); } }"
      "cube(1, center = true); }");
  EXPECT_TRUE(inside(4.4, 0, 0));
  EXPECT_FALSE(inside(0, 0, 2));
  EXPECT_TRUE(inside(2.4, 0, 4.4));
  EXPECT_FALSE(inside(2.6, 0, 4.4));
}

TEST(SolidMinkowski, OfTwoThatAreNotConvexCutsOneIntoConvexPieces) {
  // Both look like an L: of width 1, with arms of length 4 and 3.
  const auto l = [](double arm) {
    const std::string size = std::to_string(arm);
    return "union() { cube([" + size + ", 1, 1]); cube([1, " + size + ", 1]); }";
  };
  const std::string bent = "difference() { cube([4, 4, 1]); " + at(1, 1, -1, "cube(9);") + "}";
  const std::string other = "difference() { cube([3, 3, 1]); " + at(1, 1, -1, "cube(9);") + "}";
  const Inside inside("minkowski() {" + bent + other + "}");
  const Inside expected("minkowski() {" + l(4) + l(3) + "}");
  for (double x = -0.45; x < 8; x += 0.5) {
    for (double y = -0.45; y < 8; y += 0.5) {
      for (const double z : {-0.1, 0.1, 1.9, 2.1}) {
        EXPECT_EQ(inside(x, y, z), expected(x, y, z)) << x << ", " << y << ", " << z;
      }
    }
  }
}

TEST(SolidMinkowski, IsLeftOutOfTwoThatAreCurvedInwards) {
  const std::string ring = "rotate_extrude() {" + at(5, 0, 0, "circle(r = 1);") + "}";
  EXPECT_THAT(warning_of("minkowski() {" + ring + ring + "}"), HasSubstr("minkowski is left out"));
}

// --- resize ---------------------------------------------------------------------------------

TEST(SolidResize, ScalesAboutTheOriginToTheBoxOfTheUnion) {
  const ImportedDesign design =
      import_text("resize(newsize = [20, 0, 6], auto = [false, true, false]) {" +
                  at(1, 1, 1, "cube(4);") + at(5, 1, 1, "cube(4);") + "}");
  expect_box(design.view_box, Vec3(2.5, 2.5, 1.5), Vec3(22.5, 12.5, 7.5), 1e-14);
  const ImportedDesign ball = import_text("resize([0, 0, 8]) { sphere(r = 2, $fn = 4); }");
  EXPECT_NEAR(ball.view_box.max.z, 4, 1e-15);
}

TEST(SolidResize, OfATurnTakesItsCorners) {
  const ImportedDesign design = import_text("resize([12, 0, 0]) { rotate_extrude(angle = 90) {" +
                                            at(5, 0, 0, "square(1);") + "} }");
  EXPECT_NEAR(design.view_box.max.x, 12, 1e-12);
  EXPECT_NEAR(design.view_box.max.y, 6, 1e-12);
}

TEST(SolidResize, OfAnExtrudedCircleTakesItsCorners) {
  // None of the 50 lies on the y axis: they end at 9.98.
  const Inside inside(
      "resize([20, 20, 0]) { linear_extrude(height = 1) { circle(10, $fn = 50); } }");
  EXPECT_TRUE(inside(0, 10.01, 0.5));
  EXPECT_FALSE(inside(0, 10.03, 0.5));
  EXPECT_TRUE(inside(9.99, 0, 0.5));
  EXPECT_FALSE(inside(10.01, 0, 0.5));
}

TEST(SolidResize, KeepsOperationsWhoseBoxItCanFind) {
  const Inside inside("resize([20, 20, 20]) { difference() { cube(10); " +
                      at(2, 2, -1, "cube([2, 2, 20]);") + "} }");
  EXPECT_FALSE(inside(6, 6, 10));
  EXPECT_TRUE(inside(2, 2, 19.9));
  EXPECT_THAT(inside.design().scene.primitives, SizeIs(2));
}

TEST(SolidResize, TakesTheBoxOfWhatOperationsLeave) {
  // A cylinder of four corners, and what is left of it where x > 1.
  const ImportedDesign design = import_text(
      "resize([8, 0, 0]) { difference() { cylinder(h = 1, "
      "r = 2, $fn = 4); " +
      at(-9, -5, -5, "cube(10);") + "} }");
  EXPECT_NEAR(design.view_box.max.x, 16, 1e-9);
  const Inside inside("resize([0, 0, 6]) { intersection() { sphere(3); " +
                      at(-5, -5, 0, "cube(10);") + "} }");
  EXPECT_TRUE(inside(0, 0, 5.9));
  EXPECT_TRUE(inside(2.9, 0, 0.1));
}

}  // namespace
}  // namespace frontend
