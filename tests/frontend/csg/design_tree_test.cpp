#include "frontend/design_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "csg/argument_value.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "language/evaluation.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;
using testing::ElementsAre;
using testing::HasSubstr;

DesignTree evaluated(std::string_view scad) {
  const language::Evaluation evaluation = language::evaluate(
      "-", {}, [](std::string_view) {}, scad);
  return tree_of(evaluation, "a.scad");
}

ImportedDesign imported(std::string_view scad, const ImportOptions& options = {}) {
  return import_design(evaluated(scad), options);
}

/// Returns the middle of the first face of the primitive along x, in the world.
double right_side(const csgcore::Primitive& cube) { return cube.local_to_world.point(Vec3(1)).x; }

/// Returns an argument of a node.
ArgumentValue argument_of(const DesignTree& tree, uint32_t node, size_t index) {
  const auto arguments = tree.nodes->arguments_of(tree.nodes->nodes[node]);
  return {*tree.nodes, arguments[index]};
}

TEST(EvaluatedTree, KeepsAllDigits) {
  const DesignTree tree = evaluated("translate([1/3,0,0]) cube([2/3,1,1]);");
  ASSERT_EQ(tree.nodes->size(), 2u);
  EXPECT_EQ(tree.nodes->nodes[0].kind, NodeKind::kMultmatrix);
  EXPECT_EQ(tree.nodes->nodes[0].end, 2u);
  EXPECT_EQ(argument_of(tree, 0, 0).elements()[0].elements()[3].number(), 1.0 / 3);
  EXPECT_EQ(argument_of(tree, 1, 0).elements()[0].number(), 2.0 / 3);
}

TEST(EvaluatedTree, HasThePlacesOfTheDesign) {
  const DesignTree tree = evaluated("\n  union() {\n\tcube(1);\n}\n");
  const language::Place first = tree.nodes->nodes[0].place, second = tree.nodes->nodes[1].place;
  EXPECT_EQ(tree.location_of(first).line, 2u);
  EXPECT_EQ(tree.location_of(first).column, 3u);
  EXPECT_EQ(tree.location_of(second).line, 3u);
  EXPECT_EQ(tree.location_of(second).column, 2u);
  EXPECT_EQ(tree.file_of(second), "a.scad");
}

TEST(EvaluatedTree, KnowsTheFileOfAnIncludedNode) {
  const TemporaryFolder folder;
  folder.write("b.scad", "\ncube(1);\n");
  const std::string main = folder.write("a.scad", "sphere(1);\ninclude <b.scad>\n");
  const language::Evaluation evaluation = language::evaluate(main, {}, [](std::string_view) {});
  const DesignTree tree = tree_of(evaluation, main);
  ASSERT_EQ(tree.nodes->size(), 2u);
  EXPECT_EQ(tree.file_of(tree.nodes->nodes[0].place), main);
  EXPECT_THAT(tree.file_of(tree.nodes->nodes[1].place), HasSubstr("b.scad"));
  EXPECT_EQ(tree.location_of(tree.nodes->nodes[1].place).line, 2u);
}

TEST(EvaluatedTree, TakesRangesAndFunctionsForUndef) {
  const DesignTree tree =
      evaluated("polygon(points=[[0:2],[\"a\",[1,[2]]]], paths=function(x) x);");
  const ValueList points = argument_of(tree, 0, 0).elements();
  EXPECT_EQ(points[0].kind(), ValueKind::kUndef);
  EXPECT_EQ(points[1].elements()[0].text(), "a");
  EXPECT_EQ(points[1].elements()[1].elements()[1].elements()[0].number(), 2);
  EXPECT_EQ(argument_of(tree, 0, 1).kind(), ValueKind::kUndef);
}

TEST(RootModifier, LeavesItsNodeWithoutTheOthers) {
  for (const bool is_csg : {false, true}) {
    const std::string scad = "cube(1); union() !#sphere(1);";
    const ImportedDesign design = import_design(is_csg ? parse(scad, "a.csg") : evaluated(scad));
    EXPECT_EQ(design.scene.primitives.size(), 1u);
    EXPECT_TRUE(design.scene.layers.empty());
  }
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
  EXPECT_THAT(design.places, ElementsAre(0u, 2u));
}

TEST(EvaluatedDesigns, MatricesStayAsTheyAre) {
  const ImportedDesign design = imported(
      "rotate([12.3456789012345,1/7*100,33.3333333333333]) translate([1/3,sqrt(2),0]) cube(1);");
  const DesignTree tree = evaluated("rotate([12.3456789012345,1/7*100,33.3333333333333]) cube(1);");
  const ValueList rows = argument_of(tree, 0, 0).elements();
  const csgcore::Primitive& cube = design.scene.primitives[0];
  for (int row = 0; row < 3; ++row) {
    EXPECT_EQ(cube.local_to_world.linear[0][row],
              rows[static_cast<size_t>(row)].elements()[0].number());
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
