#include "frontend/importer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/scene_edit.hpp"
#include "frontend/parser.hpp"
#include "frontend/stop.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;
using csgcore::Shape;
using csgcore::Vec3;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

void expect_same(const ImportedDesign& a, const ImportedDesign& b, const std::string& text) {
  EXPECT_TRUE(csgcore::compare(a.scene, b.scene).nothing()) << text;
  EXPECT_EQ(a.view_box.min, b.view_box.min) << text;
  EXPECT_EQ(a.view_box.max, b.view_box.max) << text;
  EXPECT_EQ(a.primitive_nodes, b.primitive_nodes) << text;
  ASSERT_EQ(a.warnings.size(), b.warnings.size()) << text;
  for (size_t i = 0; i < a.warnings.size(); ++i) {
    EXPECT_EQ(a.warnings[i].text, b.warnings[i].text) << text;
  }
}

/// In one pass, and by the tree: both must say the same.
ImportedDesign import_text(const std::string& text, ImportOptions options = {}) {
  std::optional<ImportedDesign> in_one_pass;
  std::string error;
  try {
    in_one_pass = TextImport(text, "a.csg", options).finish();
  } catch (const Error& e) {
    error = e.what();
  }
  try {
    ImportedDesign design = import_design(parse(text, "a.csg"), options);
    EXPECT_EQ(error, "") << text;
    if (in_one_pass) expect_same(*in_one_pass, design, text);
    return design;
  } catch (const Error& e) {
    EXPECT_EQ(error, e.what()) << text;
    throw;
  }
}

std::string error_of(const std::string& text) {
  try {
    import_text(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::vector<std::string> warnings_of(const std::string& text) {
  std::vector<std::string> texts;
  for (const Warning& warning : import_text(text).warnings) texts.push_back(warning.text);
  return texts;
}

/// There must be one.
std::string warning_of(const std::string& text) {
  const std::vector<std::string> texts = warnings_of(text);
  EXPECT_THAT(texts, SizeIs(1)) << text;
  return texts.empty() ? "" : texts.front();
}

/// The tree with its primitives' ids: "(0-1-(2+3))", "-" for the empty set.
std::string shape_of(const csgcore::CsgTree& tree, const std::vector<Primitive>& primitives) {
  std::vector<std::string> stack;
  for (const csgcore::CsgToken& token : tree.tokens()) {
    if (token.is_primitive) {
      stack.push_back(std::to_string(primitives.at(token.value).id));
      continue;
    }
    constexpr char kSigns[] = {'+', '*', '-'};
    std::string text = "(";
    for (size_t i = stack.size() - token.value; i < stack.size(); ++i) {
      if (text.size() > 1) text += kSigns[static_cast<size_t>(token.op)];
      text += stack[i];
    }
    stack.resize(stack.size() - token.value);
    stack.push_back(text + ")");
  }
  return stack.empty() ? "-" : stack.back();
}

std::string model_of(const std::string& text, ImportOptions options = {}) {
  const ImportedDesign design = import_text(text, options);
  return shape_of(design.scene.model, design.scene.primitives);
}

/// "model | background | highlight".
std::string trees_of(const std::string& text, ImportOptions options = {}) {
  const csgcore::Scene scene = import_text(text, options).scene;
  return shape_of(scene.model, scene.primitives) + " | " +
         shape_of(scene.background, scene.primitives) + " | " +
         shape_of(scene.highlight, scene.primitives);
}

Primitive only_primitive(const std::string& text) {
  const ImportedDesign design = import_text(text);
  EXPECT_THAT(design.scene.primitives, SizeIs(1)) << text;
  return design.scene.primitives.empty() ? Primitive{} : design.scene.primitives[0];
}

// --- Primitives -----------------------------------------------------------------------------

TEST(ImporterSphere, TakesEverySpellingOfItsRadius) {
  EXPECT_EQ(only_primitive("sphere($fn = 0, $fa = 12, $fs = 2, r = 3);").r_bottom, 3);
  EXPECT_EQ(only_primitive("sphere(3);").r_bottom, 3);
  EXPECT_EQ(only_primitive("sphere(d = 3);").r_bottom, 1.5);
  EXPECT_EQ(only_primitive("sphere(r = 7, d = 3);").r_bottom, 1.5);  // as OpenSCAD
  EXPECT_EQ(only_primitive("sphere();").r_bottom, 1);
  EXPECT_EQ(only_primitive("sphere(r = undef);").r_bottom, 1);
  EXPECT_EQ(only_primitive("sphere(r = 2, colour = [1]);").r_bottom, 2);
  EXPECT_EQ(only_primitive("sphere();").shape, Shape::kSphere);
}

void expect_frustum(const std::string& text, double z_min, double z_max, double r_bottom,
                    double r_top) {
  const Primitive primitive = only_primitive(text);
  EXPECT_EQ(primitive.shape, Shape::kFrustum) << text;
  EXPECT_EQ(primitive.z_min, z_min) << text;
  EXPECT_EQ(primitive.z_max, z_max) << text;
  EXPECT_EQ(primitive.r_bottom, r_bottom) << text;
  EXPECT_EQ(primitive.r_top, r_top) << text;
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

/// As OpenSCAD 2021.01 reads them, which for some of them says nothing.
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
            "cube: size is a list of 2, and counts as missing (it must be a number or a list of "
            "three numbers)");
  expect_as("cube([1, undef, 2]);", "cube();", "size is a list with undef");
  expect_as("cube([1, 2, 3, 4]);", "cube();", "size is a list of 4");
  expect_as("cube(\"a\");", "cube();", "size is a string");
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
                  "surface(); cube([2]); surface();"),
      ElementsAre("a.csg:1:1: warning: cube: size is a string, and counts as missing; the "
                  "first of 3 (it must be a number or a list of three numbers)",
                  HasSubstr("a.csg:1:12: warning: sphere: r is a string, and"),
                  HasSubstr("a.csg:2:12: warning: cylinder: h is a string, and"),
                  HasSubstr("a.csg:2:12: warning: cylinder: r1 is a string, and"),
                  HasSubstr("a.csg:2:32: warning: cube: center is a number, and"),
                  "a.csg:2:43: warning: surface is left out; the first of 2 (it cannot be "
                  "drawn)"));
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
    // What is cut from it goes with it.
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

TEST(ImporterPrimitives, IdCountsEveryPrimitiveNodeOfTheFile) {
  const ImportedDesign design = import_text(
      "surface(); *sphere(); hull() { circle(); sphere(); } sphere(0); %sphere(); sphere(); "
      "text();");
  EXPECT_EQ(design.primitive_nodes, 8u);
  EXPECT_EQ(shape_of(design.scene.model, design.scene.primitives), "6");
  EXPECT_EQ(shape_of(design.scene.background, design.scene.primitives), "5");
}

// --- Matrices -------------------------------------------------------------------------------

TEST(ImporterMatrix, ComposesFromTheOutsideIn) {
  const Primitive primitive = only_primitive(
      "multmatrix([[1,0,0,10],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) {"
      "  multmatrix([[0,-1,0,0],[1,0,0,0],[0,0,1,0],[0,0,0,1]]) {"
      "    multmatrix([[1,0,0,1],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { sphere(); } } }");
  EXPECT_EQ(primitive.local_to_world.point(Vec3(0.0)), Vec3(10, 1, 0));
  EXPECT_EQ(primitive.local_to_world.point(Vec3(1, 0, 0)), Vec3(10, 2, 0));
}

TEST(ImporterMatrix, EndsWithItsSubtree) {
  const ImportedDesign design =
      import_text("multmatrix([[1,0,0,10],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { sphere(); } sphere();");
  EXPECT_EQ(design.scene.primitives[0].local_to_world.translation, Vec3(10, 0, 0));
  EXPECT_EQ(design.scene.primitives[1].local_to_world.translation, Vec3(0, 0, 0));
}

TEST(ImporterMatrix, IsDividedByItsLastEntryAndOtherwiseAffine) {
  const Primitive primitive =
      only_primitive("multmatrix([[1,0,0,3],[0,1,0,0],[0,0,1,0],[5,6,7,2]]) { sphere(); }");
  EXPECT_EQ(primitive.local_to_world.translation, Vec3(1.5, 0, 0));
  EXPECT_EQ(primitive.local_to_world.linear, csgcore::Mat3(0.5));
}

TEST(ImporterMatrix, MissingEntriesAreTheIdentitys) {
  EXPECT_EQ(only_primitive("multmatrix([[2],[0,1,0,4]]) { sphere(); }")
                .local_to_world.point(Vec3(1, 1, 1)),
            Vec3(2, 5, 1));
  EXPECT_EQ(only_primitive("multmatrix([[1,0,undef,4]]) { sphere(); }")
                .local_to_world.point(Vec3(0, 0, 1)),
            Vec3(4, 0, 1));
  EXPECT_EQ(only_primitive("multmatrix() { sphere(); }").local_to_world.linear, csgcore::Mat3(1.0));
}

TEST(ImporterMatrix, FlattensItsSubtree) {
  for (const char* matrix :
       {"[[inf,0,0,0]]", "[[1,0,0,nan]]", "[[1,0,0,0],[0,0,0,0],[0,0,1,0],[0,0,0,1]]",
        "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,0]]"}) {
    const std::string flat = "multmatrix(" + std::string(matrix) + ") { sphere(); } ";
    EXPECT_EQ(model_of(flat + "sphere();"), "1") << matrix;
    EXPECT_EQ(model_of("difference() { " + flat + "sphere(); }"), "-") << matrix;
    EXPECT_EQ(model_of("intersection() { sphere(); " + flat + "}"), "-") << matrix;
  }
}

TEST(ImporterMatrix, MayMirror) {
  EXPECT_LT(only_primitive("multmatrix([[-1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { sphere(); }")
                .local_to_world.determinant(),
            0);
}

// --- Colours --------------------------------------------------------------------------------

std::vector<float> color_of(const std::string& text) {
  const std::optional<csgcore::Color> color = only_primitive(text).color;
  if (!color) return {};
  return {color->r, color->g, color->b, color->a};
}

TEST(ImporterColor, TheOutermostValidOneWins) {
  EXPECT_THAT(color_of("color([1,0,0,1]) { color([0,1,0,1]) { sphere(); } }"),
              ElementsAre(1, 0, 0, 1));
  EXPECT_THAT(color_of("color([-1,-1,-1,1]) { color([0,1,0,0.5]) { sphere(); } }"),
              ElementsAre(0, 1, 0, 0.5f));
  EXPECT_THAT(color_of("color([-1,-1,-1,-1]) { sphere(); }"), IsEmpty());
  EXPECT_THAT(color_of("sphere();"), IsEmpty());
}

TEST(ImporterColor, EndsWithItsSubtree) {
  const ImportedDesign design = import_text("color([1,0,0]) { group() { sphere(); } } sphere();");
  EXPECT_TRUE(design.scene.primitives[0].color);
  EXPECT_FALSE(design.scene.primitives[1].color);
}

TEST(ImporterColor, MayBeWrittenByHand) {
  EXPECT_THAT(color_of("color(\"red\") { sphere(); }"), ElementsAre(1, 0, 0, 1));
  EXPECT_THAT(color_of("color(\"Lime\", 0.5) { sphere(); }"), ElementsAre(0, 1, 0, 0.5f));
  EXPECT_THAT(color_of("color(c = \"#0000ff\", alpha = 0.25) { sphere(); }"),
              ElementsAre(0, 0, 1, 0.25f));
  EXPECT_THAT(color_of("color(\"#f008\") { sphere(); }"), ElementsAre(1, 0, 0, 136 / 255.0f));
  EXPECT_THAT(color_of("color([0, 1]) { sphere(); }"), ElementsAre(0, 1, 1, 1));
  EXPECT_THAT(color_of("color([0, undef, 1]) { sphere(); }"), ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(color_of("color([0, 3, 0, 1]) { sphere(); }"), ElementsAre(0, 1, 0, 1));
}

TEST(ImporterColor, AnUnknownNameIsAWarning) {
  const ImportedDesign design = import_text("color(\"rad\") { sphere(); }");
  EXPECT_FALSE(design.scene.primitives[0].color);
  ASSERT_THAT(design.warnings, SizeIs(1));
  EXPECT_THAT(design.warnings[0].text,
              HasSubstr("a.csg:1:1: warning: color: \"rad\" is no colour"));
  EXPECT_THAT(warning_of("color(\"rad\"); color(\"blu\");"),
              HasSubstr("\"rad\" is no colour, and is ignored; the first of 2 (use a CSS"));
}

// --- Operations -----------------------------------------------------------------------------

TEST(ImporterOperations, HaveTheirMeaning) {
  EXPECT_EQ(model_of("sphere(); sphere();"), "(0+1)");
  EXPECT_EQ(model_of("render(convexity = 2) { sphere(); sphere(); }"), "(0+1)");
  EXPECT_EQ(model_of("difference() { sphere(); group() { sphere(); sphere(); } }"), "(0-1-2)");
  EXPECT_EQ(model_of("difference() { union() { sphere(); sphere(); } sphere(); }"), "((0+1)-2)");
  EXPECT_EQ(model_of("intersection() { sphere(); color([1,0,0]) { sphere(); sphere(); } }"),
            "(0*(1+2))");
  EXPECT_EQ(model_of("intersection() { sphere(); }"), "0");
  EXPECT_EQ(model_of(""), "-");
}

TEST(ImporterOperations, EmptyChildren) {
  EXPECT_EQ(model_of("difference() { group(); sphere(); }"), "-");
  EXPECT_EQ(model_of("difference() { group() { group(); } sphere(); }"), "-");
  EXPECT_EQ(model_of("difference() { sphere(); group(); }"), "0");
  EXPECT_EQ(model_of("intersection() { sphere(); group(); }"), "-");
  EXPECT_EQ(model_of("union() { sphere(); group(); }"), "0");
  EXPECT_EQ(model_of("hull(); linear_extrude(height = 1); sphere();"), "0");
  EXPECT_EQ(model_of("intersection() { sphere(); hull(); }"), "-");
}

TEST(ImporterPrimitives, OfExtremeSizesDoNoHarm) {
  const ImportedDesign design = import_text(
      "multmatrix([[1,0,0,0.333333]]) { cylinder(h = 1e-300, r = 1e-300); cylinder(r = 1e300); }"
      "multmatrix([[1e-100,0,0,0.666667],[0,1e-100,0,0],[0,0,1e-100,0]]) { cylinder(); sphere(); }"
      "multmatrix([[1,0,0,1.23457e+200]]) { sphere($fn = 1e300); cylinder($fn = nan); }");
  EXPECT_EQ(design.primitive_nodes, 6u);
}

TEST(ImporterOperations, AMillionLevelsDeep) {
  constexpr int kLevels = 1000000;
  std::string text;
  for (int i = 0; i < kLevels; ++i) text += i % 2 == 0 ? "group(){" : "multmatrix([[1,0,0,1]]){";
  text += "sphere();";
  text.append(kLevels, '}');
  EXPECT_EQ(only_primitive(text).local_to_world.translation, Vec3(kLevels / 2, 0, 0));
}

// --- Modifiers; compared with OpenSCAD 2021.01's pictures -------------------------------------

TEST(ImporterModifiers, BackgroundTakesNoPart) {
  EXPECT_EQ(trees_of("%sphere(); sphere();"), "1 | 0 | -");
  EXPECT_EQ(trees_of("difference() { %sphere(); sphere(); sphere(); }"), "(1-2) | 0 | -");
  EXPECT_EQ(trees_of("intersection() { sphere(); %sphere(); }"), "0 | 1 | -");
  EXPECT_EQ(trees_of("%difference() { sphere(); sphere(); } sphere();"), "2 | (0-1) | -");
  EXPECT_EQ(trees_of("%difference() { sphere(); %sphere(); }"), "- | (0+1) | -");
}

TEST(ImporterModifiers, NothingButBackgroundIsNoEmptyOperand) {
  EXPECT_EQ(trees_of("intersection() { group() { %sphere(); } sphere(); }"), "1 | 0 | -");
  EXPECT_EQ(trees_of("difference() { group() { %sphere(); } sphere(); sphere(); }"),
            "(1-2) | 0 | -");
}

TEST(ImporterModifiers, BackgroundKeepsPlaceAndColor) {
  const ImportedDesign design =
      import_text("color([0,0,1]) { multmatrix([[1,0,0,3]]) { %sphere(); } }");
  ASSERT_THAT(design.scene.primitives, SizeIs(1));
  EXPECT_EQ(design.scene.primitives[0].color->b, 1);
  EXPECT_EQ(design.scene.primitives[0].local_to_world.translation.x, 3);
}

TEST(ImporterModifiers, HighlightInAUnionIsOnlyOverlaid) {
  EXPECT_EQ(trees_of("#sphere(); sphere();"), "1 | - | 0");
  EXPECT_EQ(trees_of("group() { #sphere(); } sphere();"), "1 | - | 0");
  EXPECT_EQ(trees_of("difference() { group() { #sphere(); sphere(); } sphere(); }"),
            "(1-2) | - | 0");
}

TEST(ImporterModifiers, HighlightElsewhereTakesPartToo) {
  EXPECT_EQ(trees_of("difference() { sphere(); #sphere(); }"), "(0-1) | - | 1");
  EXPECT_EQ(trees_of("intersection() { sphere(); #sphere(); }"), "(0*1) | - | 1");
}

TEST(ImporterModifiers, AHighlightedFirstOperandHighlightsTheDifference) {
  EXPECT_EQ(trees_of("difference() { #sphere(); sphere(); } sphere();"), "2 | - | (0-1)");
  EXPECT_EQ(trees_of("intersection() { #sphere(); #sphere(); } sphere();"), "2 | - | (0*1)");
}

TEST(ImporterModifiers, WhereAllIsHighlightedItIsDrawnToo) {
  EXPECT_EQ(trees_of("#sphere();"), "0 | - | 0");
  EXPECT_EQ(trees_of("#sphere(); group() { #sphere(); }"), "(0+1) | - | (0+1)");
}

TEST(ImporterModifiers, HighlightsNest) {
  EXPECT_EQ(trees_of("#difference() { sphere(); #sphere(); } sphere();"), "2 | - | ((0-1)+1)");
  EXPECT_EQ(trees_of("%difference() { sphere(); #sphere(); } sphere();"), "2 | (0-1) | 1");
  EXPECT_EQ(trees_of("#group() { sphere(); %sphere(); } sphere();"), "2 | 1 | 0");
  EXPECT_EQ(trees_of("%#sphere(); sphere();"), "1 | 0 | 0");
  EXPECT_EQ(trees_of("render() { #sphere(); } sphere();"), "(0+1) | - | -");
  EXPECT_EQ(trees_of("render() { %sphere(); sphere(); } sphere();"), "(1+2) | - | -");
}

TEST(ImporterModifiers, RenderedIsTheSolidAlone) {
  ImportOptions rendered;
  rendered.rendered = true;
  EXPECT_EQ(trees_of("#sphere(); %sphere(); sphere();", rendered), "(0+2) | - | -");
  EXPECT_EQ(trees_of("difference() { sphere(); #group() { %sphere(); #sphere(); } }", rendered),
            "(0-2) | - | -");
  EXPECT_EQ(trees_of("difference() { %sphere(); sphere(); sphere(); }", rendered), "(1-2) | - | -");
  EXPECT_EQ(trees_of("%sphere();", rendered), "- | - | -");
  const ImportedDesign red = import_text("color(\"red\") { sphere(); }", rendered);
  EXPECT_FALSE(red.scene.primitives.at(0).color);
  EXPECT_TRUE(import_text("color(\"red\") { sphere(); }").scene.primitives.at(0).color);
}

TEST(ImporterModifiers, DeeplyNestedHighlightsStayInProportion) {
  constexpr int kLevels = 5000;
  std::string text;
  for (int i = 0; i < kLevels; ++i) text += "#difference() { sphere(); ";
  text.append(kLevels, '}');
  const ImportedDesign design = import_text("sphere();" + text);
  EXPECT_LT(design.scene.highlight.tokens().size(), 20u * kLevels);
}

TEST(ImporterModifiers, RootAndDisable) {
  EXPECT_EQ(model_of("sphere(); *sphere(); sphere();"), "(0+2)");
  EXPECT_EQ(model_of("difference() { *sphere(); sphere(); sphere(); }"), "(1-2)");
  EXPECT_EQ(model_of("sphere(); group() { sphere(); !sphere(); }"), "2");
  EXPECT_EQ(model_of("*group() { !sphere(); } sphere();"), "1");
  EXPECT_EQ(model_of("!*sphere(); sphere();"), "1");
  // The new root leaves its place and its colour behind.
  EXPECT_EQ(only_primitive("multmatrix([[1,0,0,3]]) { color([1,0,0]) { !sphere(); } }")
                .local_to_world.translation,
            Vec3(0.0));
  EXPECT_THAT(warnings_of("!sphere(); surface();"), IsEmpty());
  EXPECT_THAT(warnings_of("sphere(); *surface();"), IsEmpty());
}

// --- Polyhedra ------------------------------------------------------------------------------

csgcore::Box box_of(const Primitive& primitive) {
  EXPECT_EQ(primitive.shape, Shape::kPolyhedron);
  csgcore::Box box;
  if (!primitive.polyhedron) return box;
  for (const Vec3& vertex : primitive.polyhedron->vertices()) {
    box.merge(primitive.local_to_world.point(vertex));
  }
  return box;
}

void expect_box(const csgcore::Box& box, const Vec3& min, const Vec3& max, double tolerance) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(box.min[i], min[i], tolerance) << i;
    EXPECT_NEAR(box.max[i], max[i], tolerance) << i;
  }
}

TEST(ImporterCube, TakesEverySpellingOfItsSize) {
  const auto expect_cube = [](const std::string& text, const Vec3& min, const Vec3& max) {
    SCOPED_TRACE(text);
    expect_box(box_of(only_primitive(text)), min, max, 0);
  };
  expect_cube("cube(size = [2, 3.5, 4], center = false);", Vec3(0.0), Vec3(2, 3.5, 4));
  expect_cube("cube(size = [2, 3.5, 4], center = true);", Vec3(-1, -1.75, -2), Vec3(1, 1.75, 2));
  expect_cube("cube([1, 2, 3], true);", Vec3(-0.5, -1, -1.5), Vec3(0.5, 1, 1.5));
  expect_cube("cube(3);", Vec3(0.0), Vec3(3.0));
  expect_cube("cube(size = undef, center = undef);", Vec3(0.0), Vec3(1.0));
  expect_cube("cube();", Vec3(0.0), Vec3(1.0));
  expect_cube("multmatrix([[0,-1,0,5],[2,0,0,0],[0,0,1,0],[0,0,0,1]]) { cube([1, 2, 3]); }",
              Vec3(3, 0, 0), Vec3(5, 2, 3));
}

TEST(ImporterCube, HasColourAndId) {
  const Primitive cube = import_text("sphere(); color([1, 0, 0]) { cube(); }").scene.primitives[1];
  EXPECT_EQ(cube.id, 1u);
  EXPECT_EQ(cube.color->r, 1);
}

TEST(ImporterCube, SharesOnePolyhedron) {
  const std::vector<Primitive> cubes =
      import_text("cube([1, 2, 3]); multmatrix([[0,1,0,0],[1,0,0,0],[0,0,1,0]]) { cube(7); }")
          .scene.primitives;
  EXPECT_EQ(cubes[0].polyhedron, cubes[1].polyhedron);
}

// A tetrahedron; faces clockwise seen from outside.
const std::string kCorner = "points = [[0,0,0],[3,0,0],[0,4,0],[0,0,5]], ";
const std::string kFaces = "faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,2]]";

TEST(ImporterPolyhedron, IsTakenWhereItIsConvex) {
  const Primitive primitive = only_primitive("polyhedron(" + kCorner + kFaces + ");");
  expect_box(box_of(primitive), Vec3(0.0), Vec3(3, 4, 5), 0);
  EXPECT_EQ(primitive.polyhedron->half_spaces().size(), 4u);
  const std::string older =
      "polyhedron(" + kCorner + "triangles = [[0,1,2],[0,3,1],[0,2,3],[1,3,2]], convexity = 1);";
  const std::string positional =
      "polyhedron([[0,0],[3,0],[0,4],[0,0,5],[9,9,9]], [[0,1,2],[0,3,1],[0,2,3],[1,3,2]], 2);";
  const std::string careless =
      "polyhedron(" + kCorner + "faces = [[0,1,2],[0,3,1],[0,2,3],[1,3.2,2,-5,77,1e99,nan]]);";
  for (const std::string& text : {older, positional, careless}) {
    EXPECT_EQ(only_primitive(text).polyhedron->half_spaces().size(), 4u) << text;
    expect_box(box_of(only_primitive(text)), Vec3(0.0), Vec3(3, 4, 5), 0);
  }
}

TEST(ImporterPolyhedron, EqualOnesAreOne) {
  const std::string tetrahedron = "polyhedron(" + kCorner + kFaces + ");";
  const std::vector<Primitive> primitives =
      import_text(tetrahedron + "multmatrix([[1,0,0,9]]) { " + tetrahedron + "}" +
                  "polyhedron(points = [[0,0,0],[3,0,0],[0,4,0],[0,0,5.5]], " + kFaces + ");")
          .scene.primitives;
  EXPECT_EQ(primitives[0].polyhedron, primitives[1].polyhedron);
  EXPECT_NE(primitives[0].polyhedron, primitives[2].polyhedron);
}

TEST(ImporterPolyhedron, OfAnySize) {
  for (const char* size : {"1e-90", "1e90"}) {
    const std::string text = "polyhedron(points = [[0,0,0],[" + std::string(size) + ",0,0],[0," +
                             size + ",0],[0,0," + size + "]], " + kFaces + ");";
    const double expected = std::stod(size);
    expect_box(box_of(only_primitive(text)), Vec3(0.0), Vec3(expected), 1e-15 * expected);
  }
}

TEST(ImporterPolyhedron, IsLeftOutWhereItIsNotConvexAndClosed) {
  const std::string open = "polyhedron(" + kCorner + "faces = [[0,1,2],[0,3,1],[0,2,3]]);";
  const std::string flat = "polyhedron([[0,0],[1,0],[0,1]], [[0,1,2],[2,1,0]]);";
  // An octahedron with one vertex pushed in.
  const std::string dented =
      "polyhedron([[1,0,0],[0,1,0],[-1,0,0],[0,-1,0],[0,0,1],[0,0,0.5]], [[4,1,0],[4,2,1],[4,3,2],"
      "[4,0,3],[0,1,5],[1,2,5],[2,3,5],[3,0,5]]);";
  for (const std::string& text : {open, flat, dented}) {
    const std::string cut = "difference() { cube(); " + text + " }";
    EXPECT_EQ(model_of(cut), "0") << text;
    EXPECT_EQ(warning_of(cut),
              "a.csg:1:24: warning: polyhedron is left out (it is not the closed boundary of one "
              "convex solid with plane faces)");
  }
}

TEST(ImporterPolyhedron, FacesMayRunEitherWay) {
  const Primitive wanted = only_primitive("polyhedron(" + kCorner + kFaces + ");");
  for (const char* faces :
       {"[[2,1,0],[1,3,0],[3,2,0],[2,3,1]]", "[[0,1,2],[1,3,0],[0,2,3],[2,3,1]]"}) {
    const std::string text = "polyhedron(" + kCorner + "faces = " + faces + ");";
    EXPECT_THAT(warnings_of(text), IsEmpty());
    const Primitive primitive = only_primitive(text);
    expect_box(box_of(primitive), Vec3(0.0), Vec3(3, 4, 5), 0);
    EXPECT_EQ(primitive.polyhedron->half_spaces().size(), 4u);
    for (size_t i = 0; i < 4; ++i) {
      const csgcore::HalfSpace& found = primitive.polyhedron->half_spaces()[i];
      EXPECT_NEAR(found.offset, wanted.polyhedron->half_spaces()[i].offset, 1e-15);
    }
  }
}

/// What OpenSCAD 2021.01 makes of them (frontend/OPENSCAD.md, "Polyhedra").
TEST(ImporterPolyhedron, BadIndicesAreLeftOutOrZero) {
  const auto expect_whole = [](const std::string& faces, const std::string& warning) {
    const std::string text = "polyhedron(" + kCorner + "faces = " + faces + ");";
    EXPECT_EQ(warning_of(text), "a.csg:1:1: warning: polyhedron: " + warning);
    expect_box(box_of(only_primitive(text)), Vec3(0.0), Vec3(3, 4, 5), 0);
  };
  expect_whole("[[0,1,2,4],[0,3,1],[-1,0,2,3],[1,3,nan,2]]",
               "4 is no index of its 4 points, and is left out; the first of 3 (the first point "
               "is 0)");
  expect_whole("[[\"a\",1,2],[undef,3,1],[[1],2,3],[1,3,2]]",
               "an index of a face is a string, and counts as 0; the first of 3 (it must be a "
               "number)");
  expect_whole("[[0,1,2],[0,3,1],7,[0,2,3],undef,[1,3,2]]",
               "a face is a number, and is left out; the first of 2 (it must be a list of indices "
               "of points)");
}

TEST(ImporterPolyhedron, ABadPointEndsTheFaces) {
  for (const auto& [point, words] : {std::pair("undef", "undef"),
                                     {"7", "a number"},
                                     {"[]", "a list of 0"},
                                     {"[1]", "a list of 1"},
                                     {"[1,2,3,4]", "a list of 4"},
                                     {"[1,\"a\",3]", "a list with a string"},
                                     {"[1,nan,3]", "a list with nan"},
                                     {"[-inf,2,3]", "a list with inf"},
                                     {"[1,2,true]", "a list with a boolean"}}) {
    const std::string points =
        "polyhedron(points = [[0,0,0],[3,0,0],[0,4,0],[0,0,5]," + std::string(point) + "], ";
    // As if the points beyond it were none.
    const std::string late = points + "faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,2,4,0],[4,4,9]]);";
    EXPECT_EQ(warning_of(late), "a.csg:1:1: warning: polyhedron: a point is " + std::string(words) +
                                    ", and the faces from there on are left out (it must be a "
                                    "list of three finite numbers)");
    expect_box(box_of(only_primitive(late)), Vec3(0.0), Vec3(3, 4, 5), 0);
    const std::string early = points + "faces = [[0,1,2],[0,4,1],[0,2,3],[1,3,2]]); cube();";
    EXPECT_EQ(model_of(early), "1") << point;
    EXPECT_THAT(warnings_of(early),
                ElementsAre(HasSubstr("a point is "), HasSubstr("is left out (it is not")));
    // No face has it.
    EXPECT_THAT(warnings_of(points + kFaces + ");"), IsEmpty()) << point;
  }
}

TEST(ImporterPolyhedron, OfTooManyFacesIsNotLookedAt) {
  // Two apexes and a ring: convex, with n + 2 vertices and 2n faces.
  constexpr int kRing = 16384;
  static_assert(2ull * kRing * (kRing + 2) > (1 << 28));
  std::string points = "[0,0,1],[0,0,-1]", faces;
  for (int i = 0; i < kRing; ++i) {
    const double angle = 2 * M_PI * i / kRing;
    const std::string a = std::to_string(2 + i), b = std::to_string(2 + (i + 1) % kRing);
    points += ",[" + std::to_string(std::cos(angle)) + "," + std::to_string(std::sin(angle)) + "]";
    faces += (i == 0 ? "[" : ",[") + b + "," + a + ",0],[" + a + "," + b + ",1]";
  }
  EXPECT_THAT(warning_of("polyhedron([" + points + "],[" + faces + "]);"),
              HasSubstr("polyhedron is left out (it has too many faces)"));
}

TEST(ImporterPolyhedron, ListsThatAreNoneCountAsMissing) {
  EXPECT_THAT(
      warnings_of("polyhedron(points = 3, faces = [[0,1]]);"),
      ElementsAre(HasSubstr("points is a number, and counts as missing (it must be a list)"),
                  HasSubstr("0 is no index of its 0 points, and is left out; the first of 2")));
  EXPECT_THAT(warning_of("polyhedron([], true);"), HasSubstr("faces is a boolean"));
  EXPECT_THAT(warning_of("polyhedron([], triangles = true);"), HasSubstr("triangles is a boolean"));
}

TEST(ImporterPrimitives, PolyhedraThatAreTheEmptySetCount) {
  const std::string infinite = "polyhedron([[inf,0,0],[3,0,0],[0,4,0],[0,0,1]], " + kFaces + ");";
  const std::string nan = "polyhedron([[nan,0,0],[3,0,0],[0,4,0],[0,0,1]], " + kFaces + ");";
  const std::string flattened =
      "multmatrix([[inf,0,0,0]]) { polyhedron(" + kCorner + "faces = [[0,1,2]]); }";
  for (const std::string& empty :
       {std::string("cube(0);"), std::string("cube([1, -1, 1]);"),
        std::string("cube([-1, -1, 1]);"), std::string("cube([1, 0, 1], center = true);"),
        std::string("cube(inf);"), std::string("cube([1, nan, 1]);"), std::string("polyhedron();"),
        std::string("polyhedron([[1,2,3]], []);"), infinite, nan, flattened}) {
    EXPECT_EQ(model_of(empty + "sphere();"), "1") << empty;
    EXPECT_EQ(model_of("difference() { " + empty + " sphere(); }"), "-") << empty;
    EXPECT_EQ(import_text(empty).primitive_nodes, 1u) << empty;
  }
}

// --- OpenSCAD's facets ------------------------------------------------------------------------

/// The faces of the only primitive, 0 if it is smooth.
size_t faces_of(const std::string& text, ImportOptions options = {}) {
  const ImportedDesign design = import_text(text, options);
  EXPECT_THAT(design.scene.primitives, SizeIs(1)) << text;
  const Primitive& primitive = design.scene.primitives.at(0);
  return primitive.polyhedron ? primitive.polyhedron->half_spaces().size() : 0;
}

TEST(ImporterFacets, OfFewFragmentsAreKept) {
  EXPECT_EQ(faces_of("cylinder($fn = 6);"), 8u);
  EXPECT_EQ(faces_of("cylinder($fn = 8, r1 = 0);"), 9u);
  EXPECT_EQ(faces_of("cylinder($fn = 9);"), 0u);
  EXPECT_EQ(faces_of("cylinder($fn = 8.5);"), 0u);  // as written, not as it is truncated
  EXPECT_EQ(faces_of("cylinder($fn = 1);"), 5u);
  EXPECT_EQ(faces_of("sphere($fn = 6);"), 14u);
  for (const char* fn : {"0", "-3", "inf", "nan", "100"}) {
    EXPECT_EQ(faces_of("sphere($fn = " + std::string(fn) + ");"), 0u) << fn;
  }
  EXPECT_EQ(faces_of("cylinder();"), 0u);
}

TEST(ImporterFacets, AsTheOptionsSay) {
  const ImportOptions none{.facets = Facets::kNone};
  const ImportOptions all{.facets = Facets::kAll};
  const ImportOptions few{.few_fragments = 12};
  EXPECT_EQ(faces_of("cylinder($fn = 6);", none), 0u);
  EXPECT_EQ(faces_of("cylinder($fn = 12);", few), 14u);
  EXPECT_EQ(faces_of("cylinder($fn = 13);", few), 0u);
  EXPECT_EQ(faces_of("cylinder($fn = 3);", {.few_fragments = 0}), 0u);
  EXPECT_EQ(faces_of("cylinder($fn = 100);", all), 102u);
  EXPECT_EQ(faces_of("cylinder($fn = 0, $fa = 12, $fs = 2, r = 9);", all), 31u);
  EXPECT_EQ(faces_of("cylinder($fn = inf);", all), 5u);
  // As if every one had that $fn; cubes have their own faces.
  const ImportOptions forced{.facets = Facets::kAll, .fn = 5};
  EXPECT_EQ(faces_of("cylinder($fn = 100);", forced), 7u);
  EXPECT_EQ(faces_of("cylinder();", forced), 7u);
  EXPECT_EQ(faces_of("cylinder();", {.fn = 5}), 7u);
  EXPECT_EQ(faces_of("cylinder($fn = 5);", {.fn = 50}), 0u);
  EXPECT_EQ(faces_of("cube();", none), 6u);
}

TEST(ImporterFacets, HaveOpenScadsVertices) {
  const auto expect_vertices = [](const std::string& text, const csgcore::Mesh& mesh) {
    const Primitive primitive = only_primitive(text);
    ASSERT_TRUE(primitive.polyhedron) << text;
    const std::vector<Vec3>& vertices = primitive.polyhedron->vertices();
    ASSERT_EQ(vertices.size(), mesh.vertices.size()) << text;
    for (size_t i = 0; i < vertices.size(); ++i) {
      const Vec3 vertex = primitive.local_to_world.point(vertices[i]);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(vertex[k], mesh.vertices[i][k], 1e-14) << text;
    }
  };
  expect_vertices("sphere($fn = 7, r = 3);", csgcore::sphere_mesh(3, 7));
  expect_vertices("cylinder($fn = 6, h = 4, r1 = 3, r2 = 1);",
                  csgcore::frustum_mesh(0, 4, 3, 1, 6));
  expect_vertices("cylinder($fn = 5, h = 4, r1 = 0, r2 = 3, center = true);",
                  csgcore::frustum_mesh(-2, 2, 0, 3, 5));
}

TEST(ImporterFacets, AreSharedWhereOnlyTheSizeDiffers) {
  const auto polyhedra = [](const std::string& text) {
    std::vector<const csgcore::Polyhedron*> result;
    for (const Primitive& primitive : import_text(text).scene.primitives) {
      result.push_back(primitive.polyhedron.get());
    }
    return result;
  };
  const auto prisms =
      polyhedra("cylinder($fn = 6); cylinder($fn = 6, h = 9, r = 7, center = true);");
  EXPECT_EQ(prisms[0], prisms[1]);
  const auto cones =
      polyhedra("cylinder($fn = 6, r1 = 2, r2 = 1); cylinder($fn = 6, d1 = 8, d2 = 4);");
  EXPECT_EQ(cones[0], cones[1]);
  const auto balls = polyhedra("sphere($fn = 6); sphere($fn = 6, r = 5); sphere($fn = 7);");
  EXPECT_EQ(balls[0], balls[1]);
  EXPECT_NE(balls[0], balls[2]);
  const auto others = polyhedra(
      "cylinder($fn = 6); cylinder($fn = 6, r2 = 0); cylinder($fn = 6, r1 = 0); cylinder($fn = 5);"
      "sphere($fn = 6);");
  for (size_t i = 0; i < others.size(); ++i) {
    for (size_t k = 0; k < i; ++k) EXPECT_NE(others[i], others[k]) << i << ' ' << k;
  }
}

TEST(ImporterFacets, KeepPlaceColourAndId) {
  const std::vector<Primitive> primitives =
      import_text(
          "cube(); color([0, 1, 0]) { multmatrix([[-1,0,0,7],[0,1,0,0],[0,0,1,0]]) "
          "{ cylinder($fn = 4, h = 3, r = 2, center = true); } }")
          .scene.primitives;
  expect_box(box_of(primitives.at(1)), Vec3(5, -2, -1.5), Vec3(9, 2, 1.5), 1e-15);
  EXPECT_EQ(primitives[1].id, 1u);
  EXPECT_EQ(primitives[1].color->g, 1);
  EXPECT_LT(primitives[1].local_to_world.determinant(), 0);
}

TEST(ImporterFacets, TakeNoMemoryOutOfProportion) {
  const ImportedDesign design = import_text(
      "cylinder($fn = 50);\n sphere($fn = 1e6); cylinder($fn = 1e300);\n"
      "sphere($fn = 60); cylinder($fn = 6);",
      {.facets = Facets::kAll});
  ASSERT_THAT(design.warnings, SizeIs(1));
  EXPECT_EQ(design.warnings[0].text,
            "a.csg:2:2: warning: 2 round primitives are smooth; this is the first: more than "
            "131072 facets would be needed (give a smaller $fn)");
  std::vector<Shape> shapes;
  for (const Primitive& primitive : design.scene.primitives) shapes.push_back(primitive.shape);
  EXPECT_THAT(shapes, ElementsAre(Shape::kPolyhedron, Shape::kSphere, Shape::kFrustum,
                                  Shape::kPolyhedron, Shape::kPolyhedron));
  // Many that are small each are too much as well, but for those that their text pays for.
  std::string text;
  for (int i = 0; i < 300; ++i) text += "sphere($fn = " + std::to_string(30 + i) + ");";
  text += "cylinder($fn = 6);";
  const ImportedDesign many = import_text(text, {.facets = Facets::kAll});
  uint64_t faces = 0;
  for (const Primitive& primitive : many.scene.primitives) {
    if (primitive.polyhedron) faces += primitive.polyhedron->half_spaces().size();
  }
  EXPECT_GT(faces, 100000u);
  EXPECT_LT(faces, 131072u + 16u);
  EXPECT_EQ(many.scene.primitives.back().shape, Shape::kPolyhedron);
  EXPECT_THAT(many.warnings, SizeIs(1));
}

// --- What cannot be drawn -------------------------------------------------------------------

TEST(ImporterUnsupported, IsLeftOutWithAWarningForEachKind) {
  const ImportedDesign design =
      import_text("sphere();\nsurface();\n hull() { sphere(); }\nsurface();");
  EXPECT_EQ(shape_of(design.scene.model, design.scene.primitives), "0");
  ASSERT_THAT(design.warnings, SizeIs(2));
  EXPECT_EQ(design.warnings[0].text,
            "a.csg:2:1: warning: surface is left out; the first of 2 (it cannot be drawn)");
  EXPECT_EQ(design.warnings[1].text, "a.csg:3:2: warning: hull is left out (it cannot be drawn)");
  EXPECT_STREQ(Error(design.warnings[1]).what(),
               "a.csg:3:2: error: hull is left out (it cannot be drawn)");
}

TEST(ImporterUnsupported, MayBeAllThereIs) {
  const ImportedDesign design = import_text("surface();");
  EXPECT_TRUE(design.scene.primitives.empty());
  EXPECT_TRUE(design.view_box.empty());
  EXPECT_THAT(design.warnings, SizeIs(1));
}

TEST(ImporterUnsupported, LeavesTheRestAsItWouldBeWithout) {
  EXPECT_EQ(model_of("difference() { sphere(); surface(); sphere(); }"), "(0-2)");
  EXPECT_EQ(model_of("intersection() { sphere(); group() { surface(); } }"), "0");
  EXPECT_EQ(model_of("union() { surface(); sphere(); }"), "1");
}

TEST(ImporterUnsupported, TakesADifferenceWithItThatItIsTheBodyOf) {
  // The holes of a plate that is not drawn must not appear as bodies.
  EXPECT_EQ(model_of("difference() { surface(); sphere(); } sphere();"), "2");
  EXPECT_EQ(model_of("difference() { group() { surface(); group(); } sphere(); } sphere();"), "2");
  EXPECT_EQ(model_of("difference() { group() { surface(); sphere(); } sphere(); }"), "(1-2)");
  EXPECT_EQ(model_of("intersection() { difference() { surface(); sphere(); } sphere(); }"), "2");
}

// --- What --viewall looks at -----------------------------------------------------------------

TEST(ImporterViewBox, IsTheFacetedPrimitives) {
  // 5 fragments: the vertex nearest to -x lies at 144 degrees, to ±y at 72 degrees.
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
  // The box of the corners of the local box, not of the vertices.
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
  // An intersection that the boxes tell to be empty is not seen.
  EXPECT_DOUBLE_EQ(
      width("intersection() {" + small + "multmatrix([[1,0,0,20]]) {" + large + "} } " + small), 1);
  EXPECT_TRUE(import_text("").view_box.empty());
}

/// `!` makes the problems void of all that it does not select.
TEST(TextImport, TellsWhatIsWrongWithWhatItSelects) {
  const std::string wrong = "sphere(r = \"1\");";
  EXPECT_THAT(
      warnings_of(wrong + "cube(size = true);"),
      ElementsAre(HasSubstr("a.csg:1:1: warning: sphere"), HasSubstr(":1:17: warning: cube")));
  EXPECT_THAT(error_of(wrong + "cube(size = "), HasSubstr("a.csg:1:29: error: expected a value"));
  EXPECT_THAT(warnings_of(wrong + "group() { !sphere(); } " + wrong), IsEmpty());
  EXPECT_THAT(warnings_of("*group() {" + wrong + "}"), IsEmpty());
  EXPECT_THAT(warnings_of("hull() {" + wrong + "}" + wrong),
              ElementsAre(HasSubstr(":1:1: warning: hull"), HasSubstr(":1:26: warning: sphere")));
}

TEST(TextImport, SelectsWhateverCameBefore) {
  const std::string before =
      "color(\"nothing\") cube(); square(); *sphere(); multmatrix([[1,0,0,0.1]]) { #cube();";
  const std::string root = "hull() { %group() { !color([1,0,0]) { sphere(); } } } ";
  const ImportedDesign design = import_text(before + root + "} cube(); square();");
  EXPECT_THAT(design.warnings, IsEmpty());
  ASSERT_THAT(design.scene.primitives, SizeIs(1));
  EXPECT_EQ(design.scene.primitives[0].id, 4u);
  EXPECT_EQ(design.scene.primitives[0].local_to_world.translation, Vec3(0));
  EXPECT_EQ(design.primitive_nodes, 7u);
}

TEST(TextImport, KeepsThePlacesOfAllPrimitiveNodes) {
  const std::string text =
      "\xEF\xBB\xBF/* sphere();\r\n */ sphere();  cube();\r\n\n"
      "*group() {\n\tcircle(); }\n!union() { color(\"x\") cylinder(); }\n%text(text = "
      "\"\n\");cube();";
  EXPECT_THAT(TextImport(text, "a.csg").finish().places, IsEmpty());
  ImportOptions options;
  options.keeps_places = true;
  const ImportedDesign design = TextImport(text, "a.csg", options).finish();
  const std::string_view names[] = {"sphere", "cube", "circle", "cylinder", "text", "cube"};
  ASSERT_EQ(design.primitive_nodes, std::size(names));
  ASSERT_THAT(design.places, SizeIs(std::size(names)));
  for (size_t i = 0; i < std::size(names); ++i) {
    const PrimitivePlace& place = design.places[i];
    EXPECT_EQ(text.substr(place.offset, names[i].size()), names[i]);
    EXPECT_EQ(place.line, 1 + std::count(text.begin(), text.begin() + place.offset, '\n')) << i;
  }
  ASSERT_THAT(design.scene.primitives, SizeIs(1));
  EXPECT_EQ(design.scene.primitives[0].id, 3u);
}

TEST(TextImport, StopsWhenAsked) {
  std::stop_source stop;
  TextImport import("sphere(r = 1);", "x.csg", {}, stop.get_token());
  stop.request_stop();
  EXPECT_THROW(TextImport("sphere(r = 1);", "x.csg", {}, stop.get_token()), Stopped);
  EXPECT_THROW(import.finish(stop.get_token()), Stopped);
}

TEST(Importer, StopsWhenAsked) {
  const SyntaxTree tree = parse("sphere(r = 1);", "x.csg");
  std::stop_source stop;
  EXPECT_EQ(import_design(tree, {}, stop.get_token()).primitive_nodes, 1u);
  stop.request_stop();
  EXPECT_THROW(import_design(tree, {}, stop.get_token()), Stopped);
}

}  // namespace
}  // namespace frontend
