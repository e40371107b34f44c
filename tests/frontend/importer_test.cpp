#include "frontend/importer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "frontend/parser.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;
using csgcore::Shape;
using csgcore::Vec3;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

ImportedDesign import_text(const std::string& text, ImportOptions options = {}) {
  return import_design(parse(text, "a.csg"), options);
}

std::string error_of(const std::string& text) {
  try {
    import_text(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
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
std::string trees_of(const std::string& text) {
  const csgcore::Scene scene = import_text(text).scene;
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

TEST(ImporterPrimitives, RefuseArgumentsOfTheWrongType) {
  EXPECT_EQ(error_of("group();\n sphere(r = \"a\");"),
            "a.csg:2:2: error: sphere: r is a string (it must be a number)");
  EXPECT_THAT(error_of("cylinder(h = [1]);"), HasSubstr("h is a list"));
  EXPECT_THAT(error_of("cylinder(center = 1);"), HasSubstr("center is a number"));
  EXPECT_THAT(error_of("multmatrix(3) sphere();"), HasSubstr("error: "));
  EXPECT_THAT(error_of("multmatrix([[1, true]]) { sphere(); }"),
              HasSubstr("an entry of the matrix"));
  EXPECT_THAT(error_of("color(true) { sphere(); }"), HasSubstr("the colour is a boolean"));
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
      "cube(); *sphere(); hull() { circle(); sphere(); } sphere(0); %sphere(); sphere(); text();",
      {.skip_unsupported = true});
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
  EXPECT_EQ(error_of("!sphere(); cube();"), "no error");
  EXPECT_EQ(error_of("sphere(); *cube();"), "no error");
}

// --- What cannot be drawn -------------------------------------------------------------------

TEST(ImporterUnsupported, IsAnErrorThatNamesTheFirstAndCounts) {
  EXPECT_EQ(error_of("sphere();\n linear_extrude(height = 1) { square(); circle(); }\n"
                     "cube(); cube();"),
            "a.csg:2:2: error: linear_extrude cannot be drawn; of all nodes 3 cannot: 2 cube, "
            "1 linear_extrude (--skip-unsupported draws the rest)");
}

TEST(ImporterUnsupported, IsSkippedOnDemandWithAWarningPerKind) {
  const ImportedDesign design =
      import_text("sphere();\ncube();\n hull() { sphere(); }\ncube();", {.skip_unsupported = true});
  EXPECT_EQ(shape_of(design.scene.model, design.scene.primitives), "0");
  ASSERT_THAT(design.warnings, SizeIs(2));
  EXPECT_EQ(
      design.warnings[0].text,
      "a.csg:2:1: warning: 2 cube nodes are left out; this is the first (it cannot be drawn)");
  EXPECT_EQ(design.warnings[1].text,
            "a.csg:3:2: warning: 1 hull node is left out (it cannot be drawn)");
}

TEST(ImporterUnsupported, LeavesTheRestAsItWouldBeWithout) {
  const ImportOptions skip{.skip_unsupported = true};
  EXPECT_EQ(model_of("difference() { sphere(); cube(); sphere(); }", skip), "(0-2)");
  EXPECT_EQ(model_of("intersection() { sphere(); group() { cube(); } }", skip), "0");
  EXPECT_EQ(model_of("union() { cube(); sphere(); }", skip), "1");
}

TEST(ImporterUnsupported, TakesADifferenceWithItThatItIsTheBodyOf) {
  const ImportOptions skip{.skip_unsupported = true};
  // The holes of a plate that is not drawn must not appear as bodies.
  EXPECT_EQ(model_of("difference() { cube(); sphere(); } sphere();", skip), "2");
  EXPECT_EQ(model_of("difference() { group() { cube(); group(); } sphere(); } sphere();", skip),
            "2");
  EXPECT_EQ(model_of("difference() { group() { cube(); sphere(); } sphere(); }", skip), "(1-2)");
  EXPECT_EQ(model_of("intersection() { difference() { cube(); sphere(); } sphere(); }", skip), "2");
}

TEST(ImporterWarnings, OfRoundPrimitivesWithFewFragments) {
  const ImportedDesign design = import_text(
      "sphere($fn = 9); sphere($fn = 0);\n cylinder($fn = 6); *sphere($fn = 5); sphere($fn = 8);");
  ASSERT_THAT(design.warnings, SizeIs(1));
  EXPECT_EQ(design.warnings[0].text,
            "a.csg:2:2: warning: drawn smooth, in spite of $fn ≤ 8: 2 round primitives; this is "
            "the first (facets are not drawn yet)");
}

// --- What --viewall looks at -----------------------------------------------------------------

void expect_box(const csgcore::Box& box, const Vec3& min, const Vec3& max, double tolerance) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(box.min[i], min[i], tolerance) << i;
    EXPECT_NEAR(box.max[i], max[i], tolerance) << i;
  }
}

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

}  // namespace
}  // namespace frontend
