// Tests projection(): sections and shadows of solids.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lower/imported_text.hpp"

namespace frontend {
namespace {

using csgcore::Shape;
using csgcore::Vec3;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string moved(double x, double y, double z, const std::string& children) {
  return "multmatrix([[1,0,0," + std::to_string(x) + "],[0,1,0," + std::to_string(y) + "],[0,0,1," +
         std::to_string(z) + "],[0,0,0,1]]) {" + children + "}";
}

/// A quarter turn about x: y becomes z.
std::string upended(const std::string& children) {
  return "multmatrix([[1,0,0,0],[0,0,-1,0],[0,1,0,0],[0,0,0,1]]) {" + children + "}";
}

std::string section(const std::string& children) {
  return "linear_extrude(height = 2) { projection(cut = true) {" + children + "} }";
}

std::string shadow(const std::string& children) {
  return "linear_extrude(height = 2) { projection() {" + children + "} }";
}

ImportOptions with_facets() {
  ImportOptions options;
  options.facets = Facets::kAll;
  return options;
}

// --- projection(cut = true) -----------------------------------------------------------------

TEST(Section, OfABallIsADisc) {
  const Inside inside(section(moved(1, 2, 3, "sphere(5);")));
  EXPECT_EQ(inside.design().scene.primitives.front().shape(), Shape::kFrustum);
  EXPECT_TRUE(inside(1 + 4 - 1e-9, 2, 1));
  EXPECT_FALSE(inside(1 + 4 + 1e-9, 2, 1));
  EXPECT_EQ(model_of(section(moved(0, 0, 5, "sphere(5);"))), "-");
}

TEST(Section, OfAConeIsADiscWhereItIsCut) {
  const Inside inside(section(moved(0, 0, -1, "cylinder(h = 4, r1 = 2, r2 = 0);")));
  EXPECT_TRUE(inside(1.5 - 1e-9, 0, 1));
  EXPECT_FALSE(inside(1.5 + 1e-9, 0, 1));
}

TEST(Section, KeepsOperations) {
  EXPECT_EQ(model_of(section("difference() { sphere(5); cylinder(h = 9, r = 1); }")), "(0-0)");
  const Inside inside(section("difference() { sphere(5); cylinder(h = 9, r = 1); }"));
  // The cylinder's end touches the plane, which is enough.
  EXPECT_FALSE(inside(0, 0, 1));
  EXPECT_TRUE(inside(1 + 1e-9, 0, 1));
  EXPECT_EQ(model_of(section("intersection() { sphere(5); " + moved(0, 0, 9, "cube(1);") + "}")),
            "-");
}

TEST(Section, HasFacesThatLieInThePlane) {
  EXPECT_TRUE(Inside(section("cube(3);"))(1, 1, 1));
  EXPECT_TRUE(Inside(section(moved(0, 0, -3, "cube(3);")))(1, 1, 1));
  EXPECT_TRUE(Inside(section(moved(0, 0, -3, "cylinder(h = 3, r = 2);")))(1, 1, 1));
  // As near as OpenSCAD's grid.
  EXPECT_TRUE(
      Inside(section("multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,8e-7]]) { cube(3); }"))(1, 1, 1));
  EXPECT_THAT(warning_of(section("multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,1e-6]]) { cube(3); }")),
              HasSubstr("projection: Projection() failed"));
}

TEST(Section, OfAPolyhedronIsAPolygon) {
  const Inside inside(section(moved(0, 0, -1, "polyhedron(" + kCorner + kFaces + ");")));
  EXPECT_TRUE(inside(2.4 - 1e-9, 1e-10, 1));
  EXPECT_FALSE(inside(2.4 + 1e-9, 1e-10, 1));
  EXPECT_TRUE(inside(1e-10, 3.2 - 1e-9, 1));
}

TEST(Section, OfAMeshThatIsOpenIsEmpty) {
  EXPECT_THAT(warning_of(section("polyhedron(" + kCorner + "faces = [[0,1,2],[0,3,1],[0,2,3]]);")),
              HasSubstr("projection: The given mesh is not closed"));
}

TEST(Section, TakesWhatIsTurned) {
  const Inside inside(section(upended("linear_extrude(height = 4) { text(\"\"); circle(3); }")));
  EXPECT_TRUE(inside(2.99, -2, 1));
  EXPECT_FALSE(inside(3.01, -2, 1));
  EXPECT_FALSE(inside(0, -4.01, 1));
  const Inside ring(section("rotate_extrude() { " + moved(5, 0, 0, "circle(1);") + "}"));
  EXPECT_TRUE(ring(4.01, 0, 1));
  EXPECT_FALSE(ring(3.99, 0, 1));
  EXPECT_FALSE(ring(0, 6.01, 1));
}

TEST(Section, OfATwistedExtrusionIsTurned) {
  const Inside inside(
      section(moved(0, 0, -5, "linear_extrude(height = 10, twist = -180) { square([4, 1]); }")));
  EXPECT_TRUE(inside(-0.5, 3.9, 1));
  EXPECT_FALSE(inside(3.9, 0.5, 1));
}

TEST(Section, OfAHullIsThatOfItsPieces) {
  const Inside inside(section("hull() { sphere(2); " + moved(9, 0, 0, "sphere(2);") + "}"));
  EXPECT_TRUE(inside(5, 2 - 1e-9, 1));
  EXPECT_FALSE(inside(5, 2 + 1e-9, 1));
  EXPECT_TRUE(inside(11 - 1e-9, 0, 1));
}

TEST(Section, WithFacetsIsOpenScadsPolygon) {
  const Inside inside(section("sphere(10, $fn = 6);"), with_facets());
  EXPECT_TRUE(inside(9.99, 0, 1));
  EXPECT_FALSE(inside(0, 8.67, 1));
  EXPECT_TRUE(inside(0, 8.66, 1));
}

// --- projection() ---------------------------------------------------------------------------

TEST(Shadow, OfRoundSolidsIsRound) {
  const Inside inside(shadow(moved(0, 0, 9, "sphere(2);") + moved(5, 0, 0, "cylinder(h = 1);")));
  EXPECT_TRUE(inside(0, 2 - 1e-9, 1));
  EXPECT_FALSE(inside(0, 2 + 1e-9, 1));
  EXPECT_TRUE(inside(6 - 1e-9, 0, 1));
  const Inside lying(shadow(upended("cylinder(h = 4, r = 3);")));
  EXPECT_TRUE(lying(3 - 1e-9, -4 + 1e-9, 1));
  EXPECT_FALSE(lying(3 + 1e-9, -1, 1));
}

TEST(Shadow, OfAMeshHasItsHoles) {
  const Inside inside(
      shadow("rotate_extrude(angle = 180) { " + moved(5, 0, 0, "square(2);") + "}" +
             moved(0, 20, 0,
                   "linear_extrude(height = 3, twist = 10) { difference() { circle(3); "
                   "circle(2); } }")));
  EXPECT_TRUE(inside(0, 5.1, 1));
  EXPECT_FALSE(inside(0, 4.9, 1));
  EXPECT_FALSE(inside(0, -6, 1));
  EXPECT_TRUE(inside(2.5, 20, 1));
  EXPECT_FALSE(inside(0, 20, 1));
}

TEST(Shadow, OfARingHasItsHole) {
  const Inside inside(shadow("rotate_extrude() { " + moved(5, 0, 0, "circle(1);") + "}"));
  EXPECT_TRUE(inside(0, 6 - 1e-9, 1));
  EXPECT_FALSE(inside(0, 4 - 1e-9, 1));
  EXPECT_FALSE(inside(0, 0, 1));
}

TEST(Shadow, OfAPlateHasTheHolesThatGoThrough) {
  const Inside inside(shadow("difference() { cube(10); " + moved(2, 2, -1, "cylinder(h = 12);") +
                             moved(7, 7, 5, "cylinder(h = 12);") + "}"));
  EXPECT_FALSE(inside(3 - 1e-9, 2, 1));
  EXPECT_TRUE(inside(3 + 1e-9, 2, 1));
  EXPECT_TRUE(inside(7, 7, 1));
}

TEST(Shadow, OfOperationsOnConvexSolids) {
  const Inside inside(shadow("difference() { cube(4); " + upended("cylinder(h = 50, r = 1);") +
                             "} intersection() { cube(3); " + moved(2, 2, 9, "cube(3);") + "}"));
  EXPECT_TRUE(inside(3, 3, 1));
  EXPECT_TRUE(inside(0.5, 0.5, 1));
}

TEST(Shadow, OfOperationsOnRoundSolids) {
  // A ball with a hole along x, which casts the ball's shadow; one along z is seen through.
  const std::string along_x = "multmatrix([[0,0,1,-9],[0,1,0,0],[-1,0,0,0],[0,0,0,1]]) {" +
                              std::string("cylinder(h = 18, r = 1);}");
  const Inside inside(shadow("difference() { sphere(4); " + along_x +
                             moved(0, 0, -9, "cylinder(h = 18, r = 1);") + "}"));
  EXPECT_TRUE(inside(1.01, 0, 1));
  EXPECT_TRUE(inside(0, 3.98, 1));
  EXPECT_TRUE(inside(2.8, 2.8, 1));
  EXPECT_FALSE(inside(0.99, 0, 1));
  EXPECT_FALSE(inside(4.01, 0, 1));
  const Inside of_ring(shadow("difference() { sphere(4); rotate_extrude() { " +
                              moved(5, 0, 0, "circle(2);") + "} }"));
  EXPECT_TRUE(of_ring(3.4, 0, 1)) << "what is left reaches over the groove";
  EXPECT_FALSE(of_ring(3.99, 0, 1));
}

TEST(Shadow, IsLeftOutOfOperationsWithOpenMeshes) {
  EXPECT_THAT(warnings_of(shadow("difference() { cube(4); polyhedron(points = [[0,0,0],[3,0,0],"
                                 "[0,4,0],[0,0,5]], faces = [[0,1,2],[0,3,1],[0,2,3]]); }")),
              testing::Contains(HasSubstr("projection is left out (it needs the outcome of")));
}

// --- Both -----------------------------------------------------------------------------------

TEST(Projection, IsAPlaneFigureAmongOthers) {
  EXPECT_EQ(import_text("color([1,0,0]) { projection() { sphere(1); cube(5); } }").leaves, 1u);
  const Inside inside(
      "linear_extrude(height = 1) { offset(r = 1) { projection() { cube(3); } } "
      "hull() { projection() { " +
      moved(9, 9, 0, "cube(1);") + "} " + moved(9, 0, 0, "square(1);") + "} }");
  EXPECT_TRUE(inside(-0.9, 1, 0.5));
  EXPECT_TRUE(inside(9.5, 5, 0.5));
}

TEST(Projection, MayHoldAProjection) {
  const Inside inside(section("linear_extrude(height = 3) { projection() { sphere(2); } }"));
  EXPECT_TRUE(inside(2 - 1e-9, 0, 1));
  EXPECT_FALSE(inside(2 + 1e-9, 0, 1));
}

TEST(Projection, IgnoresPlaneFigures) {
  EXPECT_THAT(warnings_of("projection() { square(9); cube(1); }"), IsEmpty());
  EXPECT_THAT(warning_of("projection(cut = true) { square(9); cube(1); }"),
              HasSubstr("Ignoring 2D child object for 3D operation"));
  EXPECT_FALSE(Inside(shadow("square(9); cube(1);"))(5, 5, 1));
}

TEST(Projection, OfNothingIsEmpty) {
  EXPECT_EQ(model_of("projection();"), "-");
  EXPECT_EQ(model_of("intersection() { square(3); projection(); }"), "-");
  EXPECT_EQ(model_of(shadow("%cube(3);")), "-");
}

TEST(Projection, IsAPlaneFigureOfAFinalRender) {
  ImportOptions options;
  options.picture = PictureKind::kRendered;
  const ImportedDesign design = import_text("union() { projection() { cube(3); } }", options);
  EXPECT_EQ(design.flat_outlines.size(), 1u);
}

}  // namespace
}  // namespace frontend
