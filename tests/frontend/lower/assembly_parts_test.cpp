// Tests into which parts a design is taken apart, by the trees of .csg files and evaluated designs.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "frontend/design_tree.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "language/evaluation.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using testing::ElementsAre;

std::vector<uint32_t> parts_of(const std::string& csg) {
  return import_design(parse(csg, "a.csg"), {.keeps_places = true}).parts;
}

const std::string kMatrix = "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) ";

TEST(AssemblyParts, AreTheFirstThatTheTreeDividesInto) {
  EXPECT_THAT(parts_of("cube(1); sphere(1); cube(2);"), ElementsAre(0, 1, 2));
  EXPECT_THAT(parts_of("group() { " + kMatrix +
                       "{ color([1, 0, 0, 1]) { cube(1); group(); sphere(1); } } }"),
              ElementsAre(0, 1));
  EXPECT_THAT(parts_of("group() { cube(1); cube(1); } group() { sphere(1); }"),
              ElementsAre(0, 0, 1));
}

TEST(AssemblyParts, StayWholeWhereAnOperationPutsThemTogether) {
  EXPECT_THAT(parts_of("union() { cube(1); sphere(1); }"), ElementsAre(0, 0));
  EXPECT_THAT(parts_of("hull() { cube(1); sphere(1); } sphere(2);"), ElementsAre(0, 0, 1));
  EXPECT_THAT(parts_of("intersection() { group() { cube(1); cube(2); } sphere(1); }"),
              ElementsAre(0, 0, 0));
}

TEST(AssemblyParts, OfADifferenceAreThoseOfItsFirstOperand) {
  EXPECT_THAT(parts_of("difference() { group() { cube(1); sphere(1); } cube(3); }"),
              ElementsAre(0, 1, 0));
}

TEST(AssemblyParts, OfWhatARootModifierShowsAreThose) {
  EXPECT_THAT(parts_of("cube(1); !group() { cube(1); sphere(1); } cube(1);"),
              ElementsAre(0, 0, 1, 0));
}

TEST(AssemblyParts, AreCallsOfModulesThatOnlyCallOthers) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.scad",
                                        "module foot() { cube(1); sphere(1); }\n"
                                        "module feet() { foot(); translate([5, 0]) foot(); }\n"
                                        "cube(9); feet(); translate([0, 5]) feet(); foot();\n");
  const DesignTree tree = tree_of(language::evaluate(path, {}, [](std::string_view) {}), path);
  EXPECT_THAT(import_design(tree, {.keeps_places = true}).parts,
              ElementsAre(0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5));
}

}  // namespace
}  // namespace frontend
