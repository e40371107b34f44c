// Tests 2D nodes, linear_extrude and rotate_extrude: what is inside of them, and what they tell.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "csgcore/triangle_mesh.hpp"
#include "frontend/parser.hpp"
#include "lower/imported_text.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;
using csgcore::Shape;
using csgcore::Vec3;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::string moved(double x, double y, const std::string& children) {
  return "multmatrix([[1,0,0," + std::to_string(x) + "],[0,1,0," + std::to_string(y) +
         "],[0,0,1,0],[0,0,0,1]]) {" + children + "}";
}

std::string extruded(const std::string& children, const std::string& arguments = "height = 4") {
  return "linear_extrude(" + arguments + ") {" + children + "}";
}

std::string revolved(const std::string& children, const std::string& arguments = "angle = 360") {
  return "rotate_extrude(" + arguments + ") {" + children + "}";
}

Shape shape_of_only(const std::string& text) { return only_primitive(text).shape(); }

// --- linear_extrude -------------------------------------------------------------------------

TEST(LinearExtrude, MakesASolidOfEachFigure) {
  EXPECT_EQ(shape_of_only(extruded("circle(r = 2);")), Shape::kFrustum);
  EXPECT_EQ(shape_of_only(extruded("square(2);")), Shape::kPolyhedron);
  EXPECT_EQ(shape_of_only(extruded("polygon([[0,0],[3,0],[0,3]]);")), Shape::kPolyhedron);
  EXPECT_EQ(shape_of_only(extruded("polygon([[0,0],[3,0],[1,1],[0,3]]);")), Shape::kExtrusion);
  EXPECT_EQ(model_of(extruded("difference() { square(9); union() { circle(1); circle(2); } }")),
            "(0-1-2)");
  EXPECT_EQ(model_of(extruded("intersection() { square(9); circle(1); } circle(2);")), "((0*1)+2)");
}

TEST(LinearExtrude, ReachesFromZeroOrIsCentered) {
  expect_box(import_text(extruded("square([2, 3]);")).view_box, Vec3(0, 0, 0), Vec3(2, 3, 4), 0);
  expect_box(
      import_text(extruded("square([2, 3], center = true);", "height = 4, center = true")).view_box,
      Vec3(-1, -1.5, -2), Vec3(1, 1.5, 2), 0);
  EXPECT_EQ(import_text(extruded("square(1);", "")).view_box.max.z, 100);
  EXPECT_EQ(import_text(extruded("square(1);", "5, center = 1")).view_box.max.z, 5);
  EXPECT_EQ(import_text(extruded("square(1);", "height = inf")).view_box.max.z, 100);
  EXPECT_EQ(model_of(extruded("square(1);", "height = 0") + "cube(1);"), "1");
}

TEST(LinearExtrude, TakesXAndYOfMatrices) {
  const Inside inside(
      extruded("multmatrix([[2,0,7,1],[0,3,7,2],[5,5,5,5],[0,0,0,1]]) {"
               "circle(r = 1); }"));
  EXPECT_TRUE(inside(2.9, 2, 2));
  EXPECT_TRUE(inside(1, 4.9, 2));
  EXPECT_FALSE(inside(2.9, 4.9, 2));
  EXPECT_FALSE(inside(1, 2, 4.1));
}

TEST(LinearExtrude, ScalesAboutItsOrigin) {
  for (const char* figure :
       {"circle(r = 1, $fn = 100);", "square(2, center = true);",
        "polygon([[-1,-1],[1,-1],[1,1],[0,0.9],[-1,1]]);", "circle(r = 1, $fn = 4);"}) {
    const Inside inside(extruded(moved(10, 0, figure), "height = 4, scale = 0.5"));
    EXPECT_TRUE(inside(10, 0, 0.01)) << figure;
    EXPECT_TRUE(inside(10.9, 0, 0.01)) << figure;
    EXPECT_TRUE(inside(5, 0, 3.99)) << figure;
    EXPECT_TRUE(inside(5.4, 0, 3.99)) << figure;
    EXPECT_FALSE(inside(5.6, 0, 3.99)) << figure;
    EXPECT_FALSE(inside(4.4, 0, 3.99)) << figure;
    EXPECT_TRUE(inside(7.5, 0, 2)) << figure;
    EXPECT_FALSE(inside(10, 0, 2)) << figure;
  }
  const Inside point(extruded(moved(10, 0, "square(2, center = true);"),
                              "height = 4, center = true, scale = [0, 0]"));
  EXPECT_TRUE(point(0.25, 0, 1.9));
  EXPECT_FALSE(point(0.3, 0, 1.9));
  EXPECT_TRUE(point(9.9, 0.9, -1.95));
}

TEST(LinearExtrude, TurnsClockwise) {
  const std::string bar = moved(5, 0, "square([4, 1], center = true);");
  const Inside smooth(extruded(bar, "height = 4, twist = 90"));
  // At the height z the bar points to −90°·z/4.
  EXPECT_TRUE(smooth(5, 0, 0.01));
  EXPECT_TRUE(smooth(5 * std::sqrt(0.5), -5 * std::sqrt(0.5), 2));
  EXPECT_TRUE(smooth(0, -5, 3.99));
  EXPECT_FALSE(smooth(0, 5, 3.99));
  EXPECT_FALSE(smooth(5, 0, 2));
  EXPECT_FALSE(smooth(5, 0, -0.01));
  EXPECT_FALSE(smooth(0, -5, 4.01));
}

TEST(LinearExtrude, ScalesAfterItTurns) {
  const Inside inside(extruded(moved(5, 0, "square([4, 1], center = true);"),
                               "height = 4, center = true, twist = -90, scale = [1, 2]"));
  EXPECT_TRUE(inside(5, 0, -1.99));
  EXPECT_TRUE(inside(0, 13.5, 1.99));
  EXPECT_FALSE(inside(0.8, 10, 1.99));
  EXPECT_FALSE(inside(0, 6.4 * 1.5, -1.99));
}

TEST(LinearExtrude, MayEndInALineOrAPoint) {
  const Inside line(extruded("square(2, center = true);", "height = 4, scale = [0, 1]"));
  EXPECT_TRUE(line(0, 0.99, 3.99));
  EXPECT_FALSE(line(0.1, 0, 3.9));
  EXPECT_TRUE(line(0.9, 0, 0.1));
  const Inside point(extruded("square(2, center = true);", "height = 4, scale = 0, twist = 360"));
  EXPECT_TRUE(point(0, 0, 3.99));
  EXPECT_FALSE(point(0.1, 0.1, 3.9));
}

TEST(LinearExtrude, OfADiscAboutTheAxisIsAFrustum) {
  EXPECT_EQ(shape_of_only(extruded("circle(2);", "height = 4, twist = 90, scale = 0.5")),
            Shape::kFrustum);
  EXPECT_EQ(model_of(extruded("circle(2);", "height = 4, twist = 90, scale = [1, 2]")), "0");
  EXPECT_EQ(model_of(extruded(moved(1, 0, "circle(2);"), "height = 4, twist = 90")), "0");
}

TEST(LinearExtrude, HasOpenScadsSlicesWhereTheyAreMeant) {
  // One slice: the sides are spanned between the ends, which are a half turn apart.
  const std::string bar = "square([8, 1], center = true);";
  const std::string one_slice = "height = 4, twist = 90, slices = 1";
  EXPECT_FALSE(Inside(extruded(bar, one_slice))(2.5, -2.5, 2));
  EXPECT_TRUE(Inside(extruded(bar, one_slice), {.facets = Facets::kNone})(2.5, -2.5, 2));
  EXPECT_TRUE(Inside(extruded(bar, "height = 4, twist = 90, slices = 100"))(2.5, -2.5, 2));
}

TEST(LinearExtrude, HasNoCornersOfRoundingWhereItsSidesTurn) {
  const std::string octagons = "minkowski() { circle(3, $fn = 8); circle(1, $fn = 8); }";
  for (const char* arguments : {"height = 10, twist = 30, slices = 1, $fn = 8",
                                "height = 10, scale = [1.5, 0.4], slices = 1, $fn = 8"}) {
    const Primitive solid = only_primitive(extruded(octagons, arguments));
    ASSERT_TRUE(solid.mesh());
    EXPECT_EQ(solid.mesh()->triangles().size(), 8 * 2 + 2 * 6u);  // sides, and both ends
  }
}

TEST(LinearExtrude, ShowsTheSidesThatAHalfTurnFolds) {
  const std::string bar = "polygon([[1, 0], [5, 0], [5, 3], [1, 3]]);";
  const auto sheets = [&](const std::string& arguments) {
    const ImportedDesign design = import_text(extruded(bar, arguments));
    return std::ranges::count_if(design.scene.primitives, [](const Primitive& primitive) {
      return primitive.mesh() && !primitive.mesh()->is_closed();
    });
  };
  EXPECT_EQ(sheets("height = 6, twist = 180, slices = 1"), 8);
  EXPECT_EQ(sheets("height = 6, twist = -360, slices = 2"), 16);
  EXPECT_EQ(sheets("height = 6, twist = 540, slices = 1, scale = 2"), 8);
  EXPECT_EQ(sheets("height = 6, twist = 179, slices = 1"), 0);
  EXPECT_EQ(sheets("height = 6, twist = 360, slices = 1"), 0);
  EXPECT_EQ(sheets("height = 6, twist = 180, slices = 1, scale = [1, 2]"), 0);
  EXPECT_THAT(warning_of(extruded(bar, "height = 6, twist = 180, slices = 1")),
              HasSubstr("turns by half a turn in a slice"));
}

TEST(LinearExtrude, TellsOfFewerSlicesThanAskedFor) {
  EXPECT_THAT(warning_of(extruded("square(1);", "height = 4, twist = 90, slices = 1e9")),
              HasSubstr("linear_extrude is drawn with 131072 slices"));
}

TEST(LinearExtrude, MayLean) {
  const std::string arguments = "v = [3, 0, 4]";
  for (const char* figure : {"circle(r = 1);", "square(2, center = true);"}) {
    const Inside inside(extruded(moved(0, 5, figure), arguments));
    EXPECT_TRUE(inside(0.9, 5, 0.01)) << figure;
    EXPECT_TRUE(inside(3.9, 5, 3.99)) << figure;
    EXPECT_FALSE(inside(0, 5, 3.99)) << figure;
  }
  const Inside twisted(extruded(moved(0, 5, "circle(r = 1);"), arguments + ", twist = 180"));
  EXPECT_TRUE(twisted(3, -5, 3.99));
  const Inside as_high(extruded("square(2, center = true);", "height = 10, v = [3, 0, 4]"));
  EXPECT_TRUE(as_high(6, 0, 7.99));
  EXPECT_FALSE(as_high(6, 0, 8.01));
  EXPECT_EQ(model_of(extruded("square(1);", "v = [0, 0, -1]") + "cube(1);"), "1");
}

TEST(Fill, FillsHoles) {
  const std::string ring = "fill() { difference() { circle(r = 3); circle(r = 2); } }";
  const Inside plate(extruded(ring));
  EXPECT_TRUE(plate(0, 0, 1));
  EXPECT_TRUE(plate(2.9, 0, 1));
  EXPECT_FALSE(plate(3.1, 0, 1));
  EXPECT_TRUE(Inside(ring)(0, 0, 0.4));
  EXPECT_THAT(warnings_of(ring), IsEmpty());
  EXPECT_THAT(warnings_of("fill();"), IsEmpty());
}

TEST(Fill, OfSolidsIsTheirUnion) {
  const std::string solids = "fill() { difference() { cube(9); cube(8); } }";
  EXPECT_THAT(warning_of(solids), HasSubstr("fill: fill() not yet implemented for 3D"));
  EXPECT_FALSE(Inside(solids)(4, 4, 4));
  EXPECT_TRUE(Inside(solids)(8.5, 4, 4));
}

TEST(LinearExtrude, KeepsFacetsThatAreMeant) {
  EXPECT_EQ(shape_of_only(extruded("circle(r = 2, $fn = 6);")), Shape::kPolyhedron);
  EXPECT_EQ(shape_of_only(extruded("circle(r = 2, $fn = 30);")), Shape::kFrustum);
  EXPECT_EQ(import_text(extruded("circle(r = 2, $fn = 30);"), {.facets = Facets::kAll})
                .scene.primitives[0]
                .shape(),
            Shape::kPolyhedron);
}

// --- Polygons -------------------------------------------------------------------------------

TEST(Polygon, IsFilledByTheEvenOddRule) {
  const Inside holed(
      extruded("polygon(points = [[0,0],[9,0],[9,9],[0,9],[3,3],[6,3],[6,6],[3,6]],"
               "paths = [[0,1,2,3],[4,5,6,7]]);"));
  EXPECT_TRUE(holed(1, 1, 1));
  EXPECT_FALSE(holed(4, 4, 1));
  const Inside bow_tie(extruded("polygon([[0,0],[2,2],[2,0],[0,2]]);"));
  EXPECT_TRUE(bow_tie(0.1, 1, 1));
  EXPECT_TRUE(bow_tie(1.9, 1, 1));
  EXPECT_FALSE(bow_tie(1, 0.2, 1));
  EXPECT_EQ(model_of(extruded("polygon([[0,0],[1,0],[2,0]]);") + "cube(1);"), "1");
}

TEST(Polygon, TellsOfBadPointsAndIndices) {
  EXPECT_THAT(warning_of("polygon([[0,0],[1,0],undef,[1,1]]);"),
              HasSubstr("a.csg:1:1: warning: polygon: Unable to convert points[2] = undef to a "
                        "vec2 of numbers"));
  EXPECT_THAT(warning_of("polygon([[0,0],[1,0],[1,1,1]]);"), HasSubstr("points[2] = [1, 1, 1]"));
  EXPECT_THAT(warning_of("polygon([[0,0],[1,0],[\"a\",1]]);"), HasSubstr("points[2] = [\"a\", 1]"));
  EXPECT_THAT(warning_of("polygon([[0,0],[1,0],[inf,1]]);"), HasSubstr("points[2] = [inf, 1]"));
  EXPECT_THAT(warning_of("polygon([[0,0],[1,0],[nan,1]]);"), HasSubstr("Range check failed"));
  EXPECT_THAT(warning_of("polygon([[0,0],[1,0],[1,1]], [[0,1,2,9]]);"),
              HasSubstr("Point index 9 is out of bounds (from paths[0][3])"));
  EXPECT_THAT(warning_of("polygon([[0,0],[1,0],[1,1]], [[0,1,2],[0,-1]]);"),
              HasSubstr("Point index 4294967295 is out of bounds (from paths[1][1])"));
}

TEST(Polygon, IsEmptyWhereOpenScadsIs) {
  for (const char* polygon :
       {"polygon([[0,0],[1,0],undef,[1,1]]);", "polygon([[0,0],[1,0],[1,1]], [0,1,2]);",
        "polygon([[0,0],[1,0],[1,1]], [[]]);", "polygon([[0,0],[1,0]]);", "polygon();"}) {
    EXPECT_EQ(model_of(std::string(polygon) + "cube(1);"), "1") << polygon;
  }
  EXPECT_EQ(model_of("polygon([[0,0],[1,0],[1,1]], []);"), "0");
  EXPECT_EQ(model_of("polygon([[0,0],[1,0],[1,1]], [[0,1,2,9]]);"), "0") << "the rest is kept";
}

TEST(Square, HasOpenScadsDefaults) {
  expect_box(import_text("square();").view_box, Vec3(0.0), Vec3(1, 1, 0), 0);
  EXPECT_THAT(
      warning_of("square(\"a\");"),
      HasSubstr("square: Unable to convert square(size=\"a\", ...) parameter to a number or "
                "a vec2 of numbers"));
  EXPECT_EQ(model_of("square([1, 0]);"), "-");
  EXPECT_EQ(model_of("square(-1);"), "-");
}

// --- Mixed dimensions -----------------------------------------------------------------------

TEST(MixedDimensions, AreIgnoredWithAWarning) {
  EXPECT_THAT(warning_of(extruded("cube(2);")),
              HasSubstr("a.csg:1:29: warning: cube: Ignoring 3D child object for 2D operation"));
  EXPECT_EQ(model_of(extruded("square(2); cube(2);")), "0");
  EXPECT_EQ(model_of(extruded("intersection() { square(2); cube(2); }")), "-");
  EXPECT_EQ(model_of(extruded("difference() { square(2); cube(2); circle(1); }")), "(0-2)");
  EXPECT_EQ(model_of(extruded("group() { cube(2); square(2); }")), "-") << "the group is a solid's";
  EXPECT_THAT(warnings_of(extruded("group(); square(2);")), IsEmpty());
  EXPECT_THAT(warnings_of(extruded("circle(0); square(2);")), IsEmpty());
  EXPECT_EQ(model_of("hull() { circle(0); cube(2); }"), "-") << "what is empty has a dimension";
}

TEST(MixedDimensions, AFlatMatrixRemovesPlaneFigures) {
  EXPECT_THAT(warning_of(extruded("multmatrix([[1,0,0,0],[0,0,-1,0],[0,1,0,0]]) { square(2); }")),
              HasSubstr("Scaling a 2D object with 0 - removing object"));
  EXPECT_THAT(warnings_of("multmatrix([[1,0,0,0],[0,0,-1,0],[0,1,0,0]]) { square(2); }"), IsEmpty())
      << "the preview shows an upright plate";
}

// --- Plates ---------------------------------------------------------------------------------

TEST(Plate, IsAUnitThickAndCountsAsFlat) {
  const Inside inside("square(4);");
  EXPECT_TRUE(inside(1, 1, 0.49));
  EXPECT_TRUE(inside(1, 1, -0.49));
  EXPECT_FALSE(inside(1, 1, 0.51));
  expect_box(import_text("multmatrix([[1,0,0,0],[0,1,0,0],[0,0,3,7]]) { square(4); }").view_box,
             Vec3(0, 0, 7), Vec3(4, 4, 7), 1e-12);
  EXPECT_EQ(import_text("hull() { square(4); circle(1); }").view_box.max.z, 0);
}

TEST(Plate, FollowsTheWholeMatrix) {
  const Inside upright("multmatrix([[1,0,0,0],[0,0,-1,0],[0,1,0,0]]) { square(4); }");
  EXPECT_TRUE(upright(1, 0.4, 3));
  EXPECT_FALSE(upright(1, 1, 3));
}

TEST(Plate, CutsThickerThanItIs) {
  for (const char* cutter : {"square(2);", "circle(2);", "hull() { square(2); circle(1); }"}) {
    const Inside inside(
        "difference() { multmatrix([[1,0,0,-5],[0,1,0,-5],[0,0,1,-2]]) {"
        "cube([10, 10, 4]); }" +
        std::string(cutter) + "}");
    EXPECT_FALSE(inside(0.5, 0.5, 0.54)) << cutter;
    EXPECT_FALSE(inside(0.5, 0.5, -0.54)) << cutter;
    EXPECT_TRUE(inside(0.5, 0.5, 0.56)) << cutter;
  }
}

TEST(Plate, CountsInAFinalRenderAsTheFirstPartDoes) {
  const ImportOptions rendered{.picture = PictureKind::kRendered};
  EXPECT_EQ(model_of("square(4); cube(1); circle(1);", rendered), "(0+2)");
  const ImportedDesign flat = import_text("square(4); cube(1); circle(1);", rendered);
  ASSERT_THAT(flat.warnings, SizeIs(1));
  EXPECT_THAT(flat.warnings[0].text,
              HasSubstr("1:12: warning: cube: Ignoring 3D child object for 2D operation"));
  EXPECT_EQ(model_of("cube(1); square(4); group() { sphere(); square(1); }", rendered), "(0+2)");
  EXPECT_EQ(model_of("cube(1); group() { square(1); sphere(); }", rendered), "0");
  EXPECT_THAT(import_text("cube(1); square(4);", rendered).warnings, SizeIs(1));
  EXPECT_THAT(import_text("cube(1); square(4);").warnings, IsEmpty());
  EXPECT_EQ(model_of("%cube(1); group(); group() { square(4); }", rendered), "1");
  EXPECT_EQ(model_of("multmatrix([[1,0,0,0],[0,0,-1,0],[0,1,0,0]]) { square(4); }", rendered), "-");
  EXPECT_EQ(model_of(extruded("square(4);") + "square(9);", rendered), "0");
}

TEST(Plate, IsFlatInAFinalRenderAndHasOutlines) {
  const ImportedDesign design = import_text(
      "difference() { square(4); " + moved(1, 1, "square(1);") + " } " + moved(3, 0, "square(4);"),
      {.picture = PictureKind::kRendered});
  EXPECT_THAT(design.flat_outlines, SizeIs(2)) << "one, and a hole in it";
  EXPECT_EQ(design.view_box.min.z, 0);
  EXPECT_NEAR(design.view_box.max.z, 0, 0.01);
  EXPECT_THAT(import_text("square(4);").flat_outlines, IsEmpty());
  EXPECT_THAT(
      import_text(extruded("square(4);"), {.picture = PictureKind::kRendered}).flat_outlines,
      IsEmpty());
}

TEST(Plate, AloneMakesAPlaneFigure) {
  for (const PictureKind picture :
       {PictureKind::kPreview, PictureKind::kRendered, PictureKind::kThrownTogether}) {
    const auto is_plane_figure = [&](const std::string& text) {
      return import_text(text, {.picture = picture}).is_plane_figure;
    };
    EXPECT_TRUE(is_plane_figure("difference() { square(4); " + moved(1, 1, "square(1);") + " }"));
    EXPECT_FALSE(is_plane_figure("sphere(4); square(4);"));
    EXPECT_FALSE(is_plane_figure("sphere(4);"));
    EXPECT_FALSE(is_plane_figure(extruded("square(4);")));
    EXPECT_FALSE(is_plane_figure("group();"));
  }
}

TEST(Plate, OfRenderIsTheResults) {
  const ImportedDesign design = import_text(
      "render() { difference() { square(1000, center = true); difference() {"
      "square(1000, center = true); " +
      moved(2, 3, "square(4);") + " } } }");
  expect_box(design.view_box, Vec3(2, 3, 0), Vec3(6, 7, 0), 1e-5);
  EXPECT_EQ(design.leaves, 1u);
  EXPECT_EQ(import_text("render() { square(1); sphere(); }").scene.primitives.size(), 1u);
  EXPECT_EQ(import_text("render() { sphere(); square(1); }").scene.primitives.size(), 2u);
}

// --- hull, offset, minkowski, resize --------------------------------------------------------

TEST(PlaneHull, IsOneSolid) {
  EXPECT_EQ(shape_of_only(extruded("hull() { circle(2); " + moved(10, 0, "circle(2);") + "}")),
            Shape::kExtrusion);
  EXPECT_EQ(shape_of_only(extruded("hull() { square(2); " + moved(10, 0, "square(2);") + "}")),
            Shape::kPolyhedron);
  const Inside inside(extruded("hull() { circle(2); group() { " +
                               moved(10, 0, "difference() { circle(1); circle(0.5); }") + "} }"));
  EXPECT_TRUE(inside(5, 1.45, 1));
  EXPECT_FALSE(inside(5, 1.55, 1));
  EXPECT_TRUE(inside(10, 0, 1));
}

TEST(PlaneOffset, ReadsItsArguments) {
  const auto reach = [](const std::string& arguments) {
    return import_text("offset(" + arguments + ") { square(10); }").view_box.max.x;
  };
  EXPECT_EQ(reach("r = 2"), 12);
  EXPECT_EQ(reach("delta = 3"), 13);
  EXPECT_EQ(reach("r = 2, delta = 3"), 12);
  EXPECT_EQ(reach(""), 11);
  EXPECT_NEAR(reach("r = -2"), 8, 1e-7);
  const Inside chamfered(extruded("offset(delta = 1, chamfer = true) { square(10); }"));
  EXPECT_TRUE(chamfered(10.65, 10.65, 1));
  EXPECT_FALSE(chamfered(10.75, 10.75, 1));
  const Inside sharp(extruded("offset(delta = 1) { square(10); }"));
  EXPECT_TRUE(sharp(10.95, 10.95, 1));
}

TEST(PlaneMinkowski, FollowsOpenScadWhereAnOperandIsEmpty) {
  EXPECT_EQ(model_of("minkowski() { square(2); circle(0); }"), "-");
  EXPECT_EQ(model_of("minkowski() { circle(0); square(2); square(3); }"), "-");
  EXPECT_EQ(model_of("minkowski() { square(2); circle(0); circle(1); }"), "0");
  const Inside inside(
      extruded("minkowski() { square(2); circle(1); " + moved(5, 0, "square(1);") + "}"));
  EXPECT_TRUE(inside(4.1, 1, 1));
  EXPECT_FALSE(inside(4.1, -0.9, 1));
  EXPECT_TRUE(inside(8.9, 2, 1));
}

TEST(PlaneResize, ScalesAboutTheOrigin) {
  const auto box = [](const std::string& arguments) {
    return import_text("resize(" + arguments + ") {" +
                       moved(2, 1, "difference() { square([4, 2]); square(1); }") + "}")
        .view_box;
  };
  expect_box(box("newsize = [8, 0, 0]"), Vec3(4, 1, 0), Vec3(12, 3, 0), 1e-9);
  expect_box(box("newsize = [8, 0, 0], auto = [false, true, false]"), Vec3(4, 2, 0), Vec3(12, 6, 0),
             1e-9);
  expect_box(box("newsize = [0, 3], auto = true"), Vec3(3, 1.5, 0), Vec3(9, 4.5, 0), 1e-9);
  expect_box(box("newsize = 8"), Vec3(2, 1, 0), Vec3(6, 3, 0), 1e-9);
}

// --- rotate_extrude -------------------------------------------------------------------------

TEST(RotateExtrude, FindsTheSimplestSolid) {
  EXPECT_EQ(shape_of_only(revolved("square([2, 3]);")), Shape::kFrustum);
  EXPECT_EQ(shape_of_only(revolved("polygon([[0,0],[3,0],[0,4]]);")), Shape::kFrustum);
  EXPECT_EQ(shape_of_only(revolved("polygon([[0,0],[3,0],[2,4],[0,4]]);")), Shape::kFrustum);
  EXPECT_EQ(shape_of_only(revolved("polygon([[0,0],[3,1],[0,4]]);")), Shape::kRevolution);
  EXPECT_EQ(shape_of_only(revolved(moved(5, 0, "circle(2);"))), Shape::kRevolution);
  // A half disc: what crosses the axis is cut there.
  const ImportedDesign ball =
      import_text(revolved("intersection() { circle(2); " + moved(0, -5, "square(10);") + "}"));
  EXPECT_EQ(ball.scene.primitives[0].shape(), Shape::kSphere);
  EXPECT_THAT(ball.warnings, IsEmpty());
}

TEST(RotateExtrude, RevolvesTheOperations) {
  const Inside inside(
      revolved("difference() {" + moved(10, 0, "circle(3);") + moved(10, 0, "square(5);") + "}"));
  EXPECT_TRUE(inside(0, 8, 1));
  EXPECT_TRUE(inside(11, 0, -1));
  EXPECT_FALSE(inside(11, 0, 1));
  EXPECT_FALSE(inside(0, 0, 0));
}

TEST(RotateExtrude, TakesProfilesOfEitherSide) {
  EXPECT_EQ(shape_of_only(revolved(moved(-2, 0, "square([2, 3]);"))), Shape::kFrustum);
  const std::string both = revolved(moved(-1, 0, "square([3, 1]);"));
  EXPECT_THAT(warning_of(both),
              HasSubstr("rotate_extrude: all points for rotate_extrude() must have the same X "
                        "coordinate sign (range is -1.00 -> 2.00)"));
  EXPECT_EQ(model_of(both + "cube(1);"), "1");
}

TEST(RotateExtrude, IsLeftOutIfItsEdgesCrossTooOften) {
  // Each of the star's edges crosses nearly all others.
  constexpr int kPoints = 1101;
  std::string star = "polygon([";
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i * (kPoints / 2) / kPoints;
    star += "[" + std::to_string(9 + 8 * std::cos(angle)) + "," +
            std::to_string(8 * std::sin(angle)) + "],";
  }
  star += "]);";
  for (const std::string& design :
       {revolved(star, "$fn = 5"), "hull() {" + revolved(star, "$fn = 5") + "}"}) {
    EXPECT_THAT(warning_of(design), HasSubstr("rotate_extrude is left out: its edges cross too"));
    EXPECT_EQ(model_of(design + "cube(1);"), "1");
  }
}

TEST(RotateExtrude, OfPartOfATurn) {
  struct Case {
    double angle;
    bool at_45, at_135, at_225, at_315;
  };
  for (const Facets facets : {Facets::kNone, Facets::kAll}) {
    for (const Case& c : {Case{90, true, false, false, false}, Case{180, true, true, false, false},
                          Case{200, true, true, false, false}, Case{300, true, true, true, false},
                          Case{-90, false, false, false, true}, Case{-300, false, true, true, true},
                          Case{360, true, true, true, true}, Case{-360, true, true, true, true},
                          Case{400, true, true, true, true}}) {
      const Inside inside(
          revolved(moved(5, 0, "square(2);"), "angle = " + std::to_string(c.angle) + ", $fn = 60"),
          {.facets = facets});
      const std::string what = std::to_string(c.angle);
      const double r = 6 / std::sqrt(2);
      EXPECT_EQ(inside(r, r, 1), c.at_45) << what;
      EXPECT_EQ(inside(-r, r, 1), c.at_135) << what;
      EXPECT_EQ(inside(-r, -r, 1), c.at_225) << what;
      EXPECT_EQ(inside(r, -r, 1), c.at_315) << what;
      EXPECT_FALSE(inside(r, r, 3)) << what;
      EXPECT_FALSE(inside(0.5, 0.5, 1)) << what;
    }
  }
  EXPECT_EQ(model_of(revolved("square(1);", "angle = 0")), "-");
}

TEST(RotateExtrude, OnTheLeftStartsAtMinusX) {
  for (const Facets facets : {Facets::kNone, Facets::kAll}) {
    const Inside inside(revolved(moved(-7, 0, "square(2);"), "angle = 90, $fn = 60"),
                        {.facets = facets});
    EXPECT_TRUE(inside(-4.2, -4.2, 1));
    EXPECT_FALSE(inside(4.2, 4.2, 1));
  }
}

TEST(RotateExtrude, HasOpenScadsRings) {
  // Of a full turn the first ring lies at −x: a triangle's sides are at half the radius.
  const Inside full(revolved(moved(5, 0, "square([5, 1]);"), "angle = 360, $fn = 3"),
                    {.facets = Facets::kAll});
  EXPECT_TRUE(full(-9.9, 0, 0.5));
  EXPECT_FALSE(full(5.1, 0, 0.5));
  EXPECT_TRUE(full(4.9, 0, 0.5));
  EXPECT_FALSE(full(2.4, 0, 0.5));
}

TEST(PlaneImport, LeavesOutWhatItCannotDraw) {
  // Each edge of this polygon crosses nearly all others.
  constexpr int kCorners = 1501;
  std::string tangle = "offset(r = 1) { polygon([";
  for (int i = 0; i < kCorners; ++i) {
    const double angle = kCorners / 2 * i * 2 * std::numbers::pi / kCorners;
    tangle += "[" + std::to_string(std::cos(angle)) + ", " + std::to_string(std::sin(angle)) + "],";
  }
  tangle += "]); }";
  EXPECT_THAT(warning_of(extruded("square(2);" + tangle)), HasSubstr("offset is left out"));
  EXPECT_EQ(model_of(extruded("square(2);" + tangle)), "0");
  EXPECT_EQ(model_of("difference() {" + extruded(tangle) + "cube(1); } sphere();"), "2")
      << "no hole becomes a body";
}

TEST(PlaneImport, IgnoresModifiersInside) {
  EXPECT_EQ(trees_of(extruded("%circle(1); #square(2);")), "1 | - | -");
  EXPECT_EQ(trees_of("#" + extruded("circle(1); square(2);")), "(0+1) | - | (0+1)");
  EXPECT_EQ(trees_of("%" + extruded("circle(1); square(2);") + "cube();"), "2 | (0+1) | -");
  EXPECT_EQ(trees_of(extruded("circle(1); !square(2);")), "1 | - | -");
  EXPECT_EQ(trees_of(extruded("circle(1); *square(2);")), "0 | - | -");
  EXPECT_EQ(trees_of(extruded("*hull() { offset() { circle(1); } } square(2);")), "0 | - | -");
}

/// Solids keep places of their own in render(), whose surfaces are theirs.
TEST(PlaneImport, APlaceIsThatOfTheNodeThatMakesTheSurface) {
  const std::string text =
      "circle(1);\nlinear_extrude(height = 1) { hull() { square(1); } }\n"
      "render() { hull() { circle(2); } }\nrender() { cube(); hull() { %sphere(); cube(); } }";
  const DesignTree tree = parse(text, "a.csg");
  const ImportedDesign design = import_design(tree, {.keeps_places = true});
  std::vector<size_t> offsets;
  for (const uint32_t node : design.places) offsets.push_back(tree.nodes->nodes[node].place.offset);
  EXPECT_THAT(offsets,
              testing::ElementsAre(0u, text.find("linear_extrude"), text.find("render"),
                                   text.find("cube"), text.rfind("hull"), text.rfind("cube")));
}

TEST(PlaneImport, ForgetsColoursInside) {
  const Primitive primitive =
      only_primitive("color([0,1,0,1]) {" + extruded("color([1,0,0,1]) { square(2); }") + "}");
  EXPECT_EQ(primitive.color, (csgcore::Color{0, 1, 0, 1}));
  EXPECT_FALSE(only_primitive(extruded("color([1,0,0,1]) { square(2); }")).color);
}

TEST(FinalRender, TakesNoDimensionFromWithinABackgroundPart) {
  ImportOptions options;
  options.picture = PictureKind::kRendered;
  EXPECT_EQ(model_of("%linear_extrude(height = 1) { square(1); } cube(1);", options), "1");
}

}  // namespace
}  // namespace frontend
