// Tests matrices, operations, nodes that cannot be drawn, and the import of a text while it is
// parsed.
#include "frontend/importer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <stop_token>
#include <string>
#include <string_view>

#include "frontend/parser.hpp"
#include "frontend/stop.hpp"
#include "lower/imported_text.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;
using csgcore::Vec3;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

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
       {"[[inf,0,0,0]]", "[[1,0,0,nan]]", "[[1,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,1]]",
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

TEST(ImporterOperations, AMillionLevelsDeep) {
  constexpr int kLevels = 1000000;
  std::string text;
  for (int i = 0; i < kLevels; ++i) text += i % 2 == 0 ? "group(){" : "multmatrix([[1,0,0,1]]){";
  text += "sphere();";
  text.append(kLevels, '}');
  EXPECT_EQ(only_primitive(text).local_to_world.translation, Vec3(kLevels / 2, 0, 0));
}

// --- What cannot be drawn -------------------------------------------------------------------

TEST(ImporterUnsupported, IsLeftOutWithAWarningForEachKind) {
  const ImportedDesign design =
      import_text("sphere();\ncylinder(1e308);\n cube(1e308);\ncylinder(1e308);");
  EXPECT_EQ(shape_of(design.scene.model, design.scene.primitives), "0");
  ASSERT_THAT(design.warnings, SizeIs(2));
  EXPECT_THAT(
      design.warnings[0].text,
      testing::StartsWith("a.csg:2:1: warning: cylinder is left out; the first of 2 (it is too "));
  EXPECT_EQ(
      design.warnings[1].text,
      "a.csg:3:2: warning: cube is left out (it is too large, or too far from the origin: scale "
      "the design to between 1e-90 and 1e90 across)");
  EXPECT_THAT(Error(design.warnings[1]).what(), HasSubstr("a.csg:3:2: error: cube is left out ("));
}

TEST(ImporterUnsupported, MayBeAllThereIs) {
  const ImportedDesign design = import_text("cube(1e308);");
  EXPECT_TRUE(design.scene.primitives.empty());
  EXPECT_TRUE(design.view_box.empty());
  EXPECT_THAT(design.warnings, SizeIs(1));
}

TEST(ImporterUnsupported, LeavesTheRestAsItWouldBeWithout) {
  EXPECT_EQ(model_of("difference() { sphere(); cube(1e308); sphere(); }"), "(0-2)");
  EXPECT_EQ(model_of("intersection() { sphere(); group() { cube(1e308); } }"), "0");
  EXPECT_EQ(model_of("union() { cube(1e308); sphere(); }"), "1");
}

TEST(ImporterUnsupported, TakesADifferenceWithItThatItIsTheBodyOf) {
  // The holes of a plate that is not drawn must not appear as bodies.
  EXPECT_EQ(model_of("difference() { cube(1e308); sphere(); } sphere();"), "2");
  EXPECT_EQ(model_of("difference() { group() { cube(1e308); group(); } sphere(); } sphere();"),
            "2");
  EXPECT_EQ(model_of("difference() { group() { cube(1e308); sphere(); } sphere(); }"), "(1-2)");
  EXPECT_EQ(model_of("intersection() { difference() { cube(1e308); sphere(); } sphere(); }"), "2");
}

// --- What `!` selects, and where primitives stand -------------------------------------------

/// `!` voids the problems of everything that it does not select.
TEST(Importer, TellsWhatIsWrongWithWhatItSelects) {
  const std::string wrong = "sphere(r = \"1\");";
  EXPECT_THAT(
      warnings_of(wrong + "cube(size = true);"),
      ElementsAre(HasSubstr("a.csg:1:1: warning: sphere"), HasSubstr(":1:17: warning: cube")));
  EXPECT_THAT(error_of(wrong + "cube(size = "), HasSubstr("a.csg:1:29: error: expected a value"));
  EXPECT_THAT(warnings_of(wrong + "group() { !sphere(); } " + wrong), IsEmpty());
  EXPECT_THAT(warnings_of("*group() {" + wrong + "}"), IsEmpty());
  EXPECT_THAT(
      warnings_of("hull() {" + wrong + "}" + wrong),
      ElementsAre(HasSubstr(":1:9: warning: sphere: r is a string, and counts as missing; the "
                            "first of 2")));
}

TEST(Importer, SelectsWhateverCameBefore) {
  const std::string before =
      "color(\"nothing\") cube(); square(); *sphere(); multmatrix([[1,0,0,0.1]]) { #cube();";
  const std::string root = "hull() { %group() { !color([1,0,0]) { sphere(); } } } ";
  const ImportedDesign design = import_text(before + root + "} cube(); square();");
  EXPECT_THAT(design.warnings, IsEmpty());
  ASSERT_THAT(design.scene.primitives, SizeIs(1));
  EXPECT_EQ(design.scene.primitives[0].id, 3u);
  EXPECT_EQ(design.scene.primitives[0].local_to_world.translation, Vec3(0));
  EXPECT_EQ(design.primitive_nodes, 6u);
}

TEST(Importer, KeepsThePlacesOfAllPrimitiveNodes) {
  const std::string text =
      "/* sphere();\r\n */ sphere();  cube();\r\n\n"
      "*group() {\n\tsquare(); }\ncircle();!union() { color(\"x\") cylinder(); }\n%text(text = "
      "\"\n\");cube();";
  EXPECT_THAT(import_design(parse(text, "a.csg")).places, IsEmpty());
  ImportOptions options;
  options.keeps_places = true;
  const DesignTree tree = parse(text, "a.csg");
  const ImportedDesign design = import_design(tree, options);
  const std::string_view names[] = {"sphere", "cube", "circle", "cylinder", "text", "cube"};
  ASSERT_EQ(design.primitive_nodes, std::size(names));
  ASSERT_THAT(design.places, SizeIs(std::size(names)));
  for (size_t i = 0; i < std::size(names); ++i) {
    const language::Place place = tree.nodes->nodes[design.places[i]].place;
    EXPECT_EQ(text.substr(place.offset, names[i].size()), names[i]);
  }
  ASSERT_THAT(design.scene.primitives, SizeIs(1));
  EXPECT_EQ(design.scene.primitives[0].id, 3u);
}

TEST(Importer, StopsWhenAsked) {
  std::stop_source stop;
  const auto import = [&] {
    return import_design(parse("sphere(r = 1);", "x.csg"), {}, stop.get_token());
  };
  EXPECT_EQ(import().primitive_nodes, 1u);
  stop.request_stop();
  EXPECT_THROW(import(), Stopped);
}

}  // namespace
}  // namespace frontend
