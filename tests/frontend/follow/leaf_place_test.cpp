// Tests where a leaf is said to stand, and which calls have led to it.
#include <gmock/gmock.h>

#include <string>

#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "frontend/source_place.hpp"
#include "language/evaluation.hpp"
#include "nodes/node_label.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using testing::ElementsAre;

class LeafPlaceTest : public testing::Test {
 protected:
  /// Evaluates a design, and returns the leaf of a primitive of it.
  LeafPlace place(const std::string& scad, std::size_t primitive = 0) {
    const std::string path = folder_.write("a.scad", scad);
    const DesignTree tree = tree_of(language::evaluate(path, {}, [](std::string_view) {}), path);
    const ImportedDesign design = import_design(tree, {.keeps_places = true});
    return leaf_place(tree, design.places.at(design.scene.primitives.at(primitive).id));
  }
  /// Returns the steps of that leaf's trail.
  std::vector<std::string> trail(const std::string& scad, std::size_t primitive = 0) {
    std::vector<std::string> steps;
    for (const TrailStep& step : place(scad, primitive).trail) {
      steps.push_back(step.what + " " + text_of(step.place));
    }
    return steps;
  }
  const TemporaryFolder folder_;
};

TEST_F(LeafPlaceTest, NamesTheCallsOfTheDesignsModules) {
  EXPECT_THAT(
      trail("module knob(d) {\n"
            "  translate([1, 0, 0]) sphere(d / 2);\n"
            "}\n"
            "module plate() { cube([9, 9, 1]);\n"
            "  knob(d = 4); }\n"
            "  plate();\n",
            1),
      ElementsAre("sphere(r = 2) a.scad:2:24", "knob(d = 4) a.scad:5:3", "plate() a.scad:6:3"));
}

TEST_F(LeafPlaceTest, ControlStructuresAreNoSteps) {
  EXPECT_THAT(trail("module m() { if (true) for (i = [0:2]) translate([3 * i, 0]) let (r = i + 1)\n"
                    "  sphere(r); }\n"
                    "difference() { m(); cube(1); }",
                    1),
              ElementsAre("sphere(r = 2) a.scad:2:3", "m() a.scad:3:16"));
}

/// A module that is called twice has two trails, though its nodes have the same places.
TEST_F(LeafPlaceTest, TellsCallsOfOneModuleApart) {
  const std::string scad = "module m() sphere(1);\nm();\ntranslate([5, 0]) m();";
  EXPECT_THAT(trail(scad, 0), ElementsAre("sphere(r = 1) a.scad:1:12", "m() a.scad:2:1"));
  EXPECT_THAT(trail(scad, 1), ElementsAre("sphere(r = 1) a.scad:1:12", "m() a.scad:3:19"));
}

TEST_F(LeafPlaceTest, ChildrenStandInTheModuleThatPlacesThem) {
  const std::string scad =
      "module twice() { children(0); translate([9, 0]) children(0); }\n"
      "module in(n) children();\n"
      "twice() in(1) sphere(1);";
  const std::vector<std::string> steps = {"sphere(r = 1) a.scad:3:15", "in(1) a.scad:3:9",
                                          "twice() a.scad:3:1"};
  EXPECT_EQ(trail(scad, 0), steps);
  EXPECT_EQ(trail(scad, 1), steps);
}

TEST_F(LeafPlaceTest, NamesTheFilesOfLibraries) {
  folder_.write("lib.scad", "\nmodule ball(r)\n  sphere(r);\n");
  const LeafPlace found = place("use <lib.scad>\nball(\n 3);");
  ASSERT_EQ(found.trail.size(), 2u);
  EXPECT_EQ(found.trail[0].place.path, std::filesystem::canonical(folder_ / "lib.scad"));
  EXPECT_EQ(text_of(found.trail[0].place), "lib.scad:3:3");
  EXPECT_EQ(found.trail[1].place.path, std::filesystem::canonical(folder_ / "a.scad"));
  EXPECT_EQ(found.trail[1].what, "ball(…");
}

TEST_F(LeafPlaceTest, TheNodeThatMakesTheSurfaceIsTheLeaf) {
  const std::string scad =
      "module profile() { circle(2); }\n"
      "module post(h) linear_extrude(h) profile();\n"
      "post(h = 7);";
  EXPECT_THAT(trail(scad),
              ElementsAre("circle(r = 2) a.scad:1:20", "profile() a.scad:2:34",
                          "linear_extrude(height = 7) a.scad:2:16", "post(h = 7) a.scad:3:1"));
  EXPECT_EQ(place(scad).leaf, 2u);
  // Any of the spheres may be what is seen.
  EXPECT_THAT(trail("hull() { sphere(1); translate([5, 0]) sphere(1); }"),
              ElementsAre("hull() a.scad:1:1"));
}

TEST_F(LeafPlaceTest, ARootModifierLeavesTheTrailWhole) {
  EXPECT_THAT(trail("module a() { cube(1); b(); }\nmodule b() { cube(2); !sphere(3); }\na();"),
              ElementsAre("sphere(r = 3) a.scad:2:24", "b() a.scad:1:23", "a() a.scad:3:1"));
}

TEST_F(LeafPlaceTest, ColumnsAreInCharacters) {
  EXPECT_THAT(trail("/* ÄÖÜ€ */ cube(1);"), ElementsAre("cube(size = [1, 1, 1]) a.scad:1:12"));
}

TEST_F(LeafPlaceTest, CallsAreShownAsTheyAreSpelled) {
  EXPECT_EQ(trail("module m(t, n) sphere(1); m(\")\", (1 + 2) * 3); // m")[1],
            "m(\")\", (1 + 2) * 3) a.scad:1:27");
  EXPECT_EQ(trail("module m(t) sphere(1); m(\"äääääääääääääääääääääääääää\");")[1],
            "m(\"ääääääääääääääääää… a.scad:1:24");
}

TEST(LeafPlace, OfTheStandardInputCannotBeOpened) {
  const DesignTree tree = tree_of(language::evaluate(
                                      "-", {}, [](std::string_view) {}, "\n cube(1);"),
                                  "-");
  const LeafPlace found = leaf_place(tree, 0);
  EXPECT_EQ(text_of(found.step().place), "<stdin>:2:2");
  EXPECT_EQ(found.step().place.path, "");
}

/// The design has no other text then.
TEST(LeafPlace, OfACsgIsInTheCsg) {
  const FileText csg("group() {\n\tsphere($fn = 0, $fa = 12, $fs = 2, r = 10);\n}\n");
  const LeafPlace found = leaf_place(parse(csg, "b.csg", "/folder/b.csg"), 1);
  ASSERT_EQ(found.trail.size(), 1u);
  EXPECT_EQ(found.step().what, "sphere(r = 10)");
  EXPECT_EQ(text_of(found.step().place), "b.csg:2:2");
  EXPECT_EQ(found.step().place.path, "/folder/b.csg");
  const LeafPlace exported = leaf_place(parse(csg, "b.csg"), 1);  // openscad has made it
  EXPECT_EQ(exported.step().place.path, "");
  EXPECT_EQ(text_of(exported.step().place), ".csg:2:2");
}

std::string label(const std::string& csg) {
  const DesignTree tree = parse(csg, "");
  return label_of(*tree.nodes, tree.nodes->nodes[0]);
}

TEST(NodeLabel, TellsTheSize) {
  EXPECT_EQ(label("sphere($fn = 0, $fa = 12, $fs = 2, r = 0.1234567);"), "sphere(r = 0.123457)");
  EXPECT_EQ(label("cylinder($fn = 0, $fa = 12, $fs = 2, h = 3, r1 = 2, r2 = 2, center = false);"),
            "cylinder(h = 3, r = 2)");
  EXPECT_EQ(label("cylinder(h = 3, r1 = 2, r2 = 0);"), "cylinder(h = 3, r1 = 2, r2 = 0)");
  EXPECT_EQ(label("cube(size = [1, 2, 3], center = true);"), "cube(size = [1, 2, 3])");
  EXPECT_EQ(label("cube(5);"), "cube(5)");
  EXPECT_EQ(label("polyhedron(points = [[0, 0, 0]], faces = [[0, 0, 0], [0, 0, 0]]);"),
            "polyhedron(2 faces)");
  EXPECT_EQ(label("polygon(points = [[0, 0], [1, 0], [0, 1]], paths = undef);"),
            "polygon(3 points)");
  EXPECT_EQ(label("linear_extrude(height = 5, twist = 0, scale = [1, 1]) { square(1); }"),
            "linear_extrude(height = 5)");
  EXPECT_EQ(label("linear_extrude(height = 5, twist = 90, scale = [1, 2]) { square(1); }"),
            "linear_extrude(height = 5, twist = 90, scale = [1, 2])");
  EXPECT_EQ(label("rotate_extrude(angle = 360) { square(1); }"), "rotate_extrude()");
  EXPECT_EQ(label("rotate_extrude(angle = 90) { square(1); }"), "rotate_extrude(angle = 90)");
  EXPECT_EQ(label("hull() { cube(1); }"), "hull()");
}

TEST(NodeLabel, CutsWhatIsLong) {
  EXPECT_EQ(label("text(text = \"one\\ntwo\");"), "text(text = \"one…\")");
  EXPECT_EQ(label("import(file = \"" + std::string(30, 'a') + "\");"),
            "import(file = \"" + std::string(24, 'a') + "…\")");
  EXPECT_EQ(label("text(text = \"aäääääääääääääääää\");"), "text(text = \"aäääääääääää…\")");
  EXPECT_EQ(label("cube([1, 2, 3, 4, 5, 6]);"), "cube([1, 2, 3, 4, …])");
  EXPECT_EQ(label("cube([1, [2], 3]);"), "cube([1, […], 3])");
}

}  // namespace
}  // namespace frontend
