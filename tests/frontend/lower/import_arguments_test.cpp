// Tests the meaning of arguments of spheres, cylinders and other nodes, and the errors in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "csgcore/polyhedron.hpp"
#include "csgcore/scene_edit.hpp"
#include "lower/imported_text.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;
using csgcore::Shape;
using csgcore::Vec3;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(ImporterSphere, TakesEverySpellingOfItsRadius) {
  EXPECT_EQ(only_primitive("sphere($fn = 0, $fa = 12, $fs = 2, r = 3);")
                .as<csgcore::SphereShape>()
                .radius,
            3);
  EXPECT_EQ(only_primitive("sphere(3);").as<csgcore::SphereShape>().radius, 3);
  EXPECT_EQ(only_primitive("sphere(d = 3);").as<csgcore::SphereShape>().radius, 1.5);
  EXPECT_EQ(only_primitive("sphere(r = 7, d = 3);").as<csgcore::SphereShape>().radius,
            1.5);  // as in OpenSCAD
  EXPECT_EQ(only_primitive("sphere();").as<csgcore::SphereShape>().radius, 1);
  EXPECT_EQ(only_primitive("sphere(r = undef);").as<csgcore::SphereShape>().radius, 1);
  EXPECT_EQ(only_primitive("sphere(r = 2, colour = [1]);").as<csgcore::SphereShape>().radius, 2);
  EXPECT_EQ(only_primitive("sphere();").shape(), Shape::kSphere);
}

void expect_frustum(const std::string& text, double z_min, double z_max, double r_bottom,
                    double r_top) {
  const Primitive primitive = only_primitive(text);
  EXPECT_EQ(primitive.shape(), Shape::kFrustum) << text;
  EXPECT_EQ(primitive.as<csgcore::FrustumShape>().z_min, z_min) << text;
  EXPECT_EQ(primitive.as<csgcore::FrustumShape>().z_max, z_max) << text;
  EXPECT_EQ(primitive.as<csgcore::FrustumShape>().r_bottom, r_bottom) << text;
  EXPECT_EQ(primitive.as<csgcore::FrustumShape>().r_top, r_top) << text;
}

TEST(ImporterCylinder, TakesEverySpellingOfItsSizes) {
  expect_frustum("cylinder($fn = 0, h = 4, r1 = 2, r2 = 1, center = false);", 0, 4, 2, 1);
  expect_frustum("cylinder(h = 4, r1 = 2, r2 = 1, center = true);", -2, 2, 2, 1);
  expect_frustum("cylinder(4, 2, 1, true);", -2, 2, 2, 1);
  expect_frustum("cylinder(h = 4, r = 2);", 0, 4, 2, 2);
  expect_frustum("cylinder(h = 4, d = 2);", 0, 4, 1, 1);
  expect_frustum("cylinder(h = 4, d1 = 2, r2 = 0);", 0, 4, 1, 0);
  expect_frustum("cylinder(h = 4, r = 3, d2 = 2);", 0, 4, 3, 1);
  expect_frustum("cylinder();", 0, 1, 1, 1);
}

/// OpenSCAD 2021.01 reads them in this way, and for some gives no warning.
TEST(ImporterPrimitives, TakeArgumentsOfTheWrongTypeForMissing) {
  const auto expect_as = [](const std::string& text, const std::string& meant,
                            const std::string& warning) {
    EXPECT_THAT(warning_of(text), HasSubstr(warning));
    const ImportedDesign a = import_text(text), b = import_text(meant);
    EXPECT_TRUE(csgcore::compare(a.scene, b.scene).nothing()) << text;
    EXPECT_THAT(b.warnings, IsEmpty()) << meant;
  };
  EXPECT_EQ(warning_of("group();\n sphere(r = \"a\");"),
            "a.csg:2:2: warning: sphere: r is a string, and counts as missing (it must be a "
            "number)");
  expect_as("sphere(r = [2]);", "sphere();", "r is a list");
  expect_as("sphere(d = true, r = 3);", "sphere(r = 3);", "d is a boolean");
  expect_as("cylinder(h = [1], r = 2);", "cylinder(r = 2);", "h is a list");
  expect_as("cylinder(r1 = \"a\", r2 = 2);", "cylinder(r2 = 2);", "r1 is a string");
  expect_as("cylinder(center = 1);", "cylinder();", "center is a number");
  expect_as("cylinder(r = 2, $fn = \"6\");", "cylinder(r = 2);", "$fn is a string");
  expect_as("cube(size = [1, 2]);", "cube();",
            "cube: size is [1, 2], and counts as missing (it must be a number or a list of "
            "three numbers)");
  expect_as("cube([1, undef, 2]);", "cube();", "size is [1, undef, 2]");
  expect_as("cube([1, 2, 3, 4]);", "cube();", "size is [1, 2, 3, 4]");
  expect_as("cube(\"a\");", "cube();", "size is \"a\"");
  expect_as("cube(3, 1);", "cube(3);", "center is a number");
  expect_as("multmatrix(3) { sphere(); }", "sphere();", "the matrix is a number");
  expect_as("multmatrix([[1,0,0,5], 7, [0,0,2]]) { sphere(); }",
            "multmatrix([[1,0,0,5], [], [0,0,2]]) { sphere(); }", "a row of the matrix");
  expect_as("multmatrix([[\"a\",0,0,5],[0,1,0,3]]) { sphere(); }",
            "multmatrix([[1,0,0,5],[0,1,0,3]]) { sphere(); }", "an entry of the matrix");
  expect_as("color(true) { sphere(); }", "sphere();", "the colour is a boolean");
  expect_as("color([1, \"a\", 1]) { sphere(); }", "color([1, 0, 1]) { sphere(); }",
            "a channel is a string, and counts as 0");
  expect_as("color(\"red\", \"x\") { sphere(); }", "color(\"red\") { sphere(); }",
            "alpha is a string");
}

TEST(ImporterPrimitives, HaveAWarningForEachKindOfProblem) {
  EXPECT_THAT(
      warnings_of("cube(\"a\"); sphere(\"a\");\ncube([1]); cylinder(\"a\", \"b\"); cube(1, 1);"
                  "cube(1e308); cube([2]); cube(1e308);"),
      ElementsAre("a.csg:1:1: warning: cube: size is \"a\", and counts as missing (it must be a "
                  "number or a list of three numbers)",
                  HasSubstr("a.csg:1:12: warning: sphere: r is a string, and"),
                  HasSubstr("a.csg:2:1: warning: cube: size is [1], and"),
                  HasSubstr("a.csg:2:12: warning: cylinder: h is a string, and"),
                  HasSubstr("a.csg:2:12: warning: cylinder: r1 is a string, and"),
                  HasSubstr("a.csg:2:32: warning: cube: center is a number, and"),
                  HasSubstr("a.csg:2:43: warning: cube is left out; the first of 2 (it is too "),
                  HasSubstr("a.csg:2:56: warning: cube: size is [2], and")));
}

TEST(ImporterPrimitives, AreLeftOutWhereNoScaleMakesThemDrawable) {
  const std::string far = "multmatrix([[1,0,0,-1e100]]) { ";
  for (const std::string& large :
       {std::string("cube(1e308);"), std::string("cube(1e308, center = true);"),
        std::string("cube(1e200);"), std::string("sphere(1e100);"),
        std::string("cylinder(h = 1e308, r = 1);"),
        std::string("polyhedron([[-1e308,0,0],[1e308,0,0],[0,1e308,0],[0,0,1e308]], "
                    "[[0,1,2],[0,3,1],[0,2,3],[1,3,2]]);")}) {
    const ImportedDesign design = import_text("cube();\n" + large);
    EXPECT_EQ(shape_of(design.scene.model, design.scene.primitives), "0") << large;
    EXPECT_EQ(design.view_box.max, Vec3(1)) << large;
    ASSERT_THAT(design.warnings, SizeIs(1)) << large;
    EXPECT_THAT(design.warnings[0].text, testing::StartsWith("a.csg:2:1: warning: ")) << large;
    EXPECT_THAT(design.warnings[0].text,
                HasSubstr(" is left out (it is too large, or too far from the origin: scale the "
                          "design to between 1e-90 and 1e90 across)"));
    // What is cut from it disappears with it.
    EXPECT_EQ(model_of("difference() {" + large + "sphere(); } cube();"), "2") << large;
  }
  EXPECT_THAT(warning_of(far + "cube(); }"), HasSubstr(":1:32: warning: cube is left out (it is"));
  const std::string grown = "multmatrix([[1e300,0,0,0],[0,1e300,0,0],[0,0,1e300,0]]) { ";
  EXPECT_THAT(warning_of(grown + grown + "cube(1); } }"), HasSubstr("too large"));
  EXPECT_EQ(only_primitive(grown + "cube(1e-300); }").local_to_world.linear[0][0], 1);
  for (const char* small : {"cube(1e-100);", "cube(1e-320);", "sphere(1e-200);"}) {
    EXPECT_THAT(warning_of(small), HasSubstr("is left out (it is too small: scale the design"));
  }
  EXPECT_EQ(model_of("multmatrix([[0,0,0],[0,0,0],[0,0,0]]) { cube(); }"), "-");
  EXPECT_THAT(warnings_of("multmatrix([[0,0,0],[0,0,0],[0,0,0]]) { cube(); }"), IsEmpty());
}

TEST(ImporterPrimitives, InvalidOnesAreTheEmptySetButCount) {
  for (const char* invalid :
       {"sphere(0);", "sphere(-1);", "sphere(inf);", "sphere(nan);", "cylinder(h = 0);",
        "cylinder(h = 1, r1 = -1, r2 = 2);", "cylinder(h = 1, r1 = 0, r2 = 0);",
        "cylinder(h = inf);", "cylinder(h = nan);"}) {
    const ImportedDesign design = import_text(std::string(invalid) + "sphere();");
    EXPECT_EQ(shape_of(design.scene.model, design.scene.primitives), "1") << invalid;
    EXPECT_EQ(design.primitive_nodes, 2u) << invalid;
    EXPECT_EQ(model_of("difference() { " + std::string(invalid) + " sphere(); }"), "-") << invalid;
    EXPECT_EQ(model_of("intersection() { sphere(); " + std::string(invalid) + " }"), "-")
        << invalid;
  }
}

TEST(ImporterPrimitives, IdCountsEveryPrimitiveNodeButDisabledOnes) {
  const ImportedDesign design = import_text(
      "polygon(); *sphere(); roof() { sphere(); circle(0); } sphere(0); %sphere(); sphere(); "
      "text();");
  EXPECT_EQ(design.primitive_nodes, 7u);
  EXPECT_EQ(shape_of(design.scene.model, design.scene.primitives), "5");
  EXPECT_EQ(layers_of(design.scene, csgcore::Layer::Kind::kBackground), "4");
}

TEST(ImporterPrimitives, OfExtremeSizesDoNoHarm) {
  const ImportedDesign design = import_text(
      "multmatrix([[1,0,0,0.333333]]) { cylinder(h = 1e-300, r = 1e-300); cylinder(r = 1e300); }"
      "multmatrix([[1e-100,0,0,0.666667],[0,1e-100,0,0],[0,0,1e-100,0]]) { cylinder(); sphere(); }"
      "multmatrix([[1,0,0,1.23457e+200]]) { sphere($fn = 1e300); cylinder($fn = nan); }");
  EXPECT_EQ(design.primitive_nodes, 6u);
}

}  // namespace
}  // namespace frontend
