#include "csg/evaluated_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "language/evaluation.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;
using testing::ElementsAre;
using testing::HasSubstr;

SyntaxTree evaluated(std::string_view scad) {
  const language::Evaluation evaluation = language::evaluate(
      "-", {}, [](std::string_view) {}, scad);
  return tree_of(*evaluation.tree, *evaluation.files, "a.scad");
}

ImportedDesign imported(std::string_view scad, const ImportOptions& options = {}) {
  return import_design(evaluated(scad), options);
}

/// Returns the middle of the first face of the primitive along x, in the world.
double right_side(const csgcore::Primitive& cube) { return cube.local_to_world.point(Vec3(1)).x; }

TEST(EvaluatedTree, KeepsAllDigits) {
  const SyntaxTree tree = evaluated("translate([1/3,0,0]) cube([2/3,1,1]);");
  ASSERT_EQ(tree.nodes.size(), 2u);
  EXPECT_EQ(tree.nodes[0].kind, NodeKind::kMultmatrix);
  EXPECT_EQ(tree.nodes[0].subtree_end, 2u);
  const Value rows = tree.arguments_of(tree.nodes[0])[0].value;
  EXPECT_EQ(tree.elements_of(tree.elements_of(rows)[0])[3].number, 1.0 / 3);
  const Argument size = tree.arguments_of(tree.nodes[1])[0];
  EXPECT_EQ(size.name, "size");
  EXPECT_EQ(tree.elements_of(size.value)[0].number, 2.0 / 3);
}

TEST(EvaluatedTree, HasThePlacesOfTheDesign) {
  const SyntaxTree tree = evaluated("\n  union() {\n\tcube(1);\n}\n");
  EXPECT_EQ(tree.nodes[0].location.line, 2u);
  EXPECT_EQ(tree.nodes[0].location.column, 3u);
  EXPECT_EQ(tree.nodes[1].location.line, 3u);
  EXPECT_EQ(tree.nodes[1].location.column, 2u);
  EXPECT_THAT(tree.offsets, ElementsAre(3u, 14u));
  EXPECT_EQ(tree.file_of(tree.nodes[1].location), "a.scad");
}

TEST(EvaluatedTree, KnowsTheFileOfAnIncludedNode) {
  const TemporaryFolder folder;
  folder.write("b.scad", "\ncube(1);\n");
  const std::string main = folder.write("a.scad", "sphere(1);\ninclude <b.scad>\n");
  const language::Evaluation evaluation = language::evaluate(main, {}, [](std::string_view) {});
  const SyntaxTree tree = tree_of(*evaluation.tree, *evaluation.files, main);
  ASSERT_EQ(tree.nodes.size(), 2u);
  EXPECT_EQ(tree.file_of(tree.nodes[0].location), main);
  EXPECT_THAT(tree.file_of(tree.nodes[1].location), HasSubstr("b.scad"));
  EXPECT_EQ(tree.nodes[1].location.line, 2u);
}

TEST(EvaluatedTree, HasModifiersAndTheRootAlone) {
  const SyntaxTree marked = evaluated("#cube(1); %sphere(1);");
  EXPECT_EQ(marked.nodes[0].modifiers, kHighlight);
  EXPECT_EQ(marked.nodes[1].modifiers, kBackground);
  const SyntaxTree rooted = evaluated("cube(1); union() !#sphere(1);");
  ASSERT_EQ(rooted.nodes.size(), 1u);
  EXPECT_EQ(rooted.nodes[0].kind, NodeKind::kSphere);
  EXPECT_EQ(rooted.nodes[0].modifiers, 0);
}

TEST(EvaluatedTree, TakesRangesAndFunctionsForUndef) {
  const SyntaxTree tree =
      evaluated("polygon(points=[[0:2],[\"a\",[1,[2]]]], paths=function(x) x);");
  const auto arguments = tree.arguments_of(tree.nodes[0]);
  const auto points = tree.elements_of(arguments[0].value);
  EXPECT_EQ(points[0].kind, ValueKind::kUndef);
  EXPECT_EQ(tree.text_of(tree.elements_of(points[1])[0]), "a");
  EXPECT_EQ(tree.elements_of(tree.elements_of(tree.elements_of(points[1])[1])[1])[0].number, 2);
  EXPECT_EQ(arguments[1].value.kind, ValueKind::kUndef);
}

TEST(EvaluatedTree, IsDrawnAsTheTextOfItsCsg) {
  const ImportedDesign own = imported("difference() { cube(4); sphere(2); }");
  const ImportedDesign text = import_design(
      parse("difference() { cube(size = [4, 4, 4], center = false); sphere($fn = 0, $fa = 12, "
            "$fs = 2, r = 2); }",
            "a.csg"));
  EXPECT_EQ(own.scene.primitives.size(), text.scene.primitives.size());
  EXPECT_EQ(own.primitive_nodes, 2u);
}

TEST(EvaluatedTree, WarnsWithThePlaceInTheDesign) {
  const ImportedDesign design = imported("\npolyhedron(points=5, faces=[[0,1,2]]);");
  ASSERT_FALSE(design.warnings.empty());
  EXPECT_THAT(design.warnings[0].text, HasSubstr("a.scad:2:1: warning: polyhedron"));
}

TEST(EvaluatedTree, FillsPlaces) {
  const ImportedDesign design =
      imported("cube(1);\n render() {\nsphere(1);}", {.keeps_places = true});
  ASSERT_EQ(design.places.size(), 2u);
  EXPECT_EQ(design.places[1].line, 3u);
  EXPECT_EQ(design.places[1].offset, 21u);
  EXPECT_EQ(design.places[1].node, 2u);
}

TEST(EvaluatedDesigns, MatricesStayAsTheyAre) {
  const ImportedDesign design = imported(
      "rotate([12.3456789012345,1/7*100,33.3333333333333]) translate([1/3,sqrt(2),0]) cube(1);");
  const SyntaxTree tree = evaluated("rotate([12.3456789012345,1/7*100,33.3333333333333]) cube(1);");
  const auto rows = tree.elements_of(tree.arguments_of(tree.nodes[0])[0].value);
  const csgcore::Primitive& cube = design.scene.primitives[0];
  for (int row = 0; row < 3; ++row) {
    EXPECT_EQ(cube.local_to_world.linear[0][row], tree.elements_of(rows[row])[0].number);
  }
}

TEST(EvaluatedDesigns, TypedDigitsMeetWhatTheyStandFor) {
  // In a .csg both sides of the cut are at 0.333333.
  const ImportedDesign sizes =
      imported("difference() { cube([1/3,1,1]); translate([0,0,-1]) cube([0.333333,2,3]); }");
  EXPECT_EQ(right_side(sizes.scene.primitives[0]), right_side(sizes.scene.primitives[1]));
  const ImportedDesign moves =
      imported("translate([-2/3,0,0]) cube(1); translate([-0.666667,0,0]) cube([1,2,2]);");
  EXPECT_EQ(right_side(moves.scene.primitives[0]), right_side(moves.scene.primitives[1]));
}

TEST(EvaluatedDesigns, TypedRadiiMeetWhatTheyStandFor) {
  const ImportedDesign design =
      imported("cylinder(h=1,r=1/3,$fn=0); translate([0,0,1]) cylinder(h=1,r=0.333333);");
  const auto radius = [&](size_t i) {
    const csgcore::Primitive& cylinder = design.scene.primitives[i];
    return glm::length(cylinder.local_to_world.linear[0]) * (i == 0 ? 1.0 / 3 : 0.333333);
  };
  EXPECT_NEAR(radius(0), radius(1), 1e-12);
}

TEST(EvaluatedDesigns, TypedNumbersThatDifferStayApart) {
  const ImportedDesign design = imported("cube([0.333333,1,1]); cube([0.333334,2,2]);");
  EXPECT_NE(right_side(design.scene.primitives[0]), right_side(design.scene.primitives[1]));
}

TEST(EvaluatedDesigns, ShortNumbersStayApartFromLongOnes) {
  const ImportedDesign design = imported("cube([0.5,1,1]); cube([0.5+3e-7,2,2]);");
  EXPECT_NE(right_side(design.scene.primitives[0]), right_side(design.scene.primitives[1]));
}

}  // namespace
}  // namespace frontend
