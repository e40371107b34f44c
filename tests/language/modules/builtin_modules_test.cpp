// Each expected tree and message is what OpenSCAD 2021.01 gives.
#include <gtest/gtest.h>

#include <initializer_list>

#include "modules/evaluated.hpp"

namespace {

struct Example {
  const char* design;
  const char* csg;
  const char* messages;
};

void expect_each(std::initializer_list<Example> examples) {
  for (const Example& example : examples) {
    const language_test::Evaluated result = language_test::evaluated(example.design);
    EXPECT_EQ(result.csg, example.csg) << example.design;
    EXPECT_EQ(result.messages, example.messages) << example.design;
  }
}

TEST(BuiltinModules, MakePrimitives) {
  expect_each({
      {"cube();", "cube(size = [1, 1, 1], center = false);\n", ""},
      {"cube(5);", "cube(size = [5, 5, 5], center = false);\n", ""},
      {"cube([1,2]);", "cube(size = [1, 1, 1], center = false);\n",
       "WARNING: Unable to convert cube(size=[1, 2], ...) parameter to a number or a vec3 of "
       "numbers in file <stdin>, line 1\n"},
      {"cube([1,2,\"a\"]);", "cube(size = [1, 2, 1], center = false);\n",
       "WARNING: Unable to convert cube(size=[1, 2, \"a\"], ...) parameter to a number or a vec3 "
       "of numbers in file <stdin>, line 1\n"},
      {"cube([1,\"a\",3], center=true);", "cube(size = [1, 1, 1], center = true);\n",
       "WARNING: Unable to convert cube(size=[1, \"a\", 3], ...) parameter to a number or a vec3 "
       "of numbers in file <stdin>, line 1\n"},
      {"cube(1/0);", "cube(size = [inf, inf, inf], center = false);\n", ""},
      {"cube(0/0);", "cube(size = [-nan, -nan, -nan], center = false);\n", ""},
      {"square(3, true);", "square(size = [3, 3], center = true);\n", ""},
      {"square([1,\"a\"]);", "square(size = [1, 1], center = false);\n",
       "WARNING: Unable to convert square(size=[1, \"a\"], ...) parameter to a number or a vec2 of "
       "numbers in file <stdin>, line 1\n"},
      {"sphere(d=3);", "sphere($fn = 0, $fa = 12, $fs = 2, r = 1.5);\n", ""},
      {"sphere(r=1,d=3);", "sphere($fn = 0, $fa = 12, $fs = 2, r = 1.5);\n",
       "WARNING: Ignoring radius variable 'r' as diameter 'd' is defined too. in file <stdin>, "
       "line 1\n"},
      {"circle(1,$fs=0.001,$fa=-1);", "circle($fn = 0, $fa = 0.01, $fs = 0.01, r = 1);\n",
       "WARNING: $fs too small - clamping to 0.010000 in file <stdin>, line 1\n"
       "WARNING: $fa too small - clamping to 0.010000 in file <stdin>, line 1\n"},
      {"circle(1,$fn=\"a\",$fa=undef);", "circle($fn = 0, $fa = 0.01, $fs = 2, r = 1);\n",
       "WARNING: $fa too small - clamping to 0.010000 in file <stdin>, line 1\n"},
      {"cylinder(5,2);",
       "cylinder($fn = 0, $fa = 12, $fs = 2, h = 5, r1 = 2, r2 = 1, center = false);\n", ""},
      {"cylinder(h=1,r=2,r1=3);",
       "cylinder($fn = 0, $fa = 12, $fs = 2, h = 1, r1 = 3, r2 = 2, center = false);\n",
       "WARNING: Cylinder parameters ambiguous in file <stdin>, line 1\n"},
      {"cylinder(h=1,r1=2,d1=3,d=1);",
       "cylinder($fn = 0, $fa = 12, $fs = 2, h = 1, r1 = 1.5, r2 = 0.5, center = false);\n",
       "WARNING: Ignoring radius variable 'r1' as diameter 'd1' is defined too. in file <stdin>, "
       "line 1\n"
       "WARNING: Cylinder parameters ambiguous in file <stdin>, line 1\n"},
      {"cylinder(r=\"a\",r1=2,h=\"x\");",
       "cylinder($fn = 0, $fa = 12, $fs = 2, h = 1, r1 = 2, r2 = 1, center = false);\n", ""},
      {"sphere(1) cube(1);", "sphere($fn = 0, $fa = 12, $fs = 2, r = 1);\n",
       "WARNING: module sphere() does not support child modules in file <stdin>, line 1\n"},
      {"cube(1,2,3);", "cube(size = [1, 1, 1], center = false);\n",
       "WARNING: Too many unnamed arguments supplied in file <stdin>, line 1\n"},
      {"cube(foo=1);", "cube(size = [1, 1, 1], center = false);\n",
       "WARNING: variable foo not specified as parameter in file <stdin>, line 1\n"},
  });
}

TEST(BuiltinModules, MakePointLists) {
  expect_each({
      {"polygon([[1,function(x) x+1]]);",
       "polygon(points = [[1, function(x) (x + 1)]], paths = undef, convexity = 1);\n", ""},
      {"polyhedron([1,\"a\",[undef,true]],faces=5,convexity=0);",
       "polyhedron(points = [1, \"a\", [undef, true]], faces = 5, convexity = 1);\n", ""},
      {"polyhedron(points=[[0,0,0]],triangles=[[0,1,2]]);",
       "polyhedron(points = [[0, 0, 0]], faces = [[0, 1, 2]], convexity = 1);\n",
       "DEPRECATED: polyhedron(triangles=[]) will be removed in future releases. Use "
       "polyhedron(faces=[]) instead.\n"},
      {"polyhedron([0:1:3],[1/0,0/0,-0,1e-7]);",
       "polyhedron(points = [0 : 1 : 3], faces = [inf, nan, 0, 1e-7], convexity = 1);\n", ""},
      {"polygon();", "polygon(points = undef, paths = undef, convexity = 1);\n", ""},
      {"polygon([[0,0],[1,0],[0,1]],[[0,1,2]],convexity=1e10);",
       "polygon(points = [[0, 0], [1, 0], [0, 1]], paths = [[0, 1, 2]], convexity = 1);\n", ""},
  });
}

TEST(BuiltinModules, MakeTexts) {
  expect_each({
      {"text(\"abc\");",
       "text(text = \"abc\", size = 10, spacing = 1, font = \"\", direction = \"ltr\", language = "
       "\"en\", script = \"Latn\", halign = \"left\", valign = \"baseline\", $fn = 0, $fa = 12, "
       "$fs = 2);\n",
       ""},
      {"text();",
       "text(text = \"\", size = 10, spacing = 1, font = \"\", direction = \"ltr\", language = "
       "\"en\", halign = \"left\", valign = \"baseline\", $fn = 0, $fa = 12, $fs = 2);\n",
       ""},
      {"text(\"a\",direction=\"bar\",size=\"b\");",
       "text(text = \"a\", size = 10, spacing = 1, font = \"\", direction = \"btt\", language = "
       "\"en\", script = \"Latn\", halign = \"left\", valign = \"baseline\", $fn = 0, $fa = 12, "
       "$fs = 2);\n",
       ""},
      {"text(\"a\",script=\"latin\",language=\"x y\");",
       "text(text = \"a\", size = 10, spacing = 1, font = \"\", direction = \"ltr\", language = "
       "\"x y\", script = \"Lati\", halign = \"left\", valign = \"baseline\", $fn = 0, $fa = 12, "
       "$fs = 2);\n",
       ""},
      {"text(\"a\",script=\"hebrew\");",
       "text(text = \"a\", size = 10, spacing = 1, font = \"\", direction = \"rtl\", language = "
       "\"en\", script = \"Hebr\", halign = \"left\", valign = \"baseline\", $fn = 0, $fa = 12, "
       "$fs = 2);\n",
       ""},
      {"text(\"a\",script=\"la\");",
       "text(text = \"a\", size = 10, spacing = 1, font = \"\", direction = \"ltr\", language = "
       "\"en\", script = \"la\", halign = \"left\", valign = \"baseline\", $fn = 0, $fa = 12, $fs "
       "= 2);\n",
       ""},
      {"text(\"שלום\");",
       "text(text = \"שלום\", size = 10, spacing = 1, font = \"\", direction = \"rtl\", language = "
       "\"en\", script = \"Hebr\", halign = \"left\", valign = \"baseline\", $fn = 0, $fa = 12, "
       "$fs = 2);\n",
       ""},
      {"text(\"漢字\");",
       "text(text = \"漢字\", size = 10, spacing = 1, font = \"\", direction = \"ltr\", language = "
       "\"en\", script = \"Hani\", halign = \"left\", valign = \"baseline\", $fn = 0, $fa = 12, "
       "$fs = 2);\n",
       ""},
      {"text(\"aб\");",
       "text(text = \"aб\", size = 10, spacing = 1, font = \"\", direction = \"ltr\", language = "
       "\"en\", halign = \"left\", valign = \"baseline\", $fn = 0, $fa = 12, $fs = 2);\n",
       ""},
      {"text(\"12\");",
       "text(text = \"12\", size = 10, spacing = 1, font = \"\", direction = \"ltr\", language = "
       "\"en\", halign = \"left\", valign = \"baseline\", $fn = 0, $fa = 12, $fs = 2);\n",
       ""},
      {"text(\"\\U010300\");",
       "text(text = \"𐌀\", size = 10, spacing = 1, font = \"\", direction = \"invalid\", language "
       "= \"en\", script = \"Ital\", halign = \"left\", valign = \"baseline\", $fn = 0, $fa = 12, "
       "$fs = 2);\n",
       ""},
  });
}

TEST(BuiltinModules, MakeTransforms) {
  expect_each({
      {"translate([1,2]) cube(1);",
       "multmatrix([[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"translate([1,\"a\"]) cube(1);",
       "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"translate([1,\"a\",3]) cube(1);",
       "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Unable to convert translate([1, \"a\", 3]) parameter to a vec3 or vec2 of numbers "
       "in file <stdin>, line 1\n"},
      {"translate([1/0,2,3]) cube(1);",
       "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Unable to convert translate([inf, 2, 3]) parameter to a vec3 or vec2 of numbers "
       "in file <stdin>, line 1\n"},
      {"translate() cube(1);",
       "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Unable to convert translate(undef) parameter to a vec3 or vec2 of numbers in file "
       "<stdin>, line 1\n"},
      {"scale([2,\"a\",3]) cube(1);",
       "multmatrix([[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Unable to convert scale([2, \"a\", 3]) parameter to a number, a vec3 or vec2 of "
       "numbers or a number in file <stdin>, line 1\n"},
      {"scale(1/0) cube(1);",
       "multmatrix([[inf, nan, nan, 0], [nan, inf, nan, 0], [nan, nan, inf, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"scale(\"a\") cube(1);",
       "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Unable to convert scale(\"a\") parameter to a number, a vec3 or vec2 of numbers "
       "or a number in file <stdin>, line 1\n"},
      {"rotate(30) cube(1);",
       "multmatrix([[0.866025, -0.5, 0, 0], [0.5, 0.866025, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"rotate(30, [0/0, 7]) cube(1);",
       "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"rotate([10,20,30]) cube(1);",
       "multmatrix([[0.813798, -0.44097, 0.378522, 0], [0.469846, 0.882564, 0.0180283, 0], "
       "[-0.34202, 0.163176, 0.925417, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"rotate([10,\"a\",30]) cube(1);",
       "multmatrix([[0.75, -0.417212, 0.513258, 0], [0.433013, 0.896281, 0.0958182, 0], [-0.5, "
       "0.150384, 0.852869, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Problem converting rotate(a=[10, \"a\", 30]) parameter in file <stdin>, line 1\n"},
      {"rotate([10,20,30,40]) cube(1);",
       "multmatrix([[0.813798, -0.44097, 0.378522, 0], [0.469846, 0.882564, 0.0180283, 0], "
       "[-0.34202, 0.163176, 0.925417, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Problem converting rotate(a=[10, 20, 30, 40]) parameter in file <stdin>, line "
       "1\n"},
      {"rotate([1/0,2,3]) cube(1);",
       "multmatrix([[0.998021, nan, nan, 0], [0.0523041, nan, nan, 0], [-0.0348995, nan, nan, 0], "
       "[0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Problem converting rotate(a=[inf, 2, 3]) parameter in file <stdin>, line 1\n"},
      {"rotate([10,20,0/0]) cube(1);",
       "multmatrix([[nan, nan, nan, 0], [nan, nan, nan, 0], [nan, nan, nan, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Problem converting rotate(a=[10, 20, nan]) parameter in file <stdin>, line 1\n"},
      {"rotate([90,0,45],[0,0,1]) cube(1);",
       "multmatrix([[0.707107, 0, 0.707107, 0], [0.707107, 0, -0.707107, 0], [0, 1, 0, 0], [0, 0, "
       "0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: When parameter a is supplied as vector, v is ignored rotate(a=[90, 0, 45], v=[0, "
       "0, 1]) in file <stdin>, line 1\n"},
      {"rotate(30,[1,2,3]) cube(1);",
       "multmatrix([[0.875595, -0.381753, 0.29597, 0], [0.420031, 0.904304, -0.0762129, 0], "
       "[-0.238552, 0.191048, 0.952152, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"rotate(30,[1,2,\"a\"]) cube(1);",
       "multmatrix([[0.888355, -0.159466, 0.430577, 0], [0.248782, 0.955342, -0.159466, 0], "
       "[-0.385919, 0.248782, 0.888355, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Problem converting rotate(..., v=[1, 2, \"a\"]) parameter in file <stdin>, line "
       "1\n"},
      {"rotate(30,[1,\"a\"]) cube(1);",
       "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"rotate(a=\"a\",v=\"b\") cube(1);",
       "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Problem converting rotate(a=\"a\", v=\"b\") parameter in file <stdin>, line 1\n"},
      {"rotate(1/0,[1,0,0]) cube(1);",
       "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Problem converting rotate(a=inf) parameter in file <stdin>, line 1\n"},
      {"mirror([1,1,1]) cube(1);",
       "multmatrix([[0.333333, -0.666667, -0.666667, 0], [-0.666667, 0.333333, -0.666667, 0], "
       "[-0.666667, -0.666667, 0.333333, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"mirror(5) cube(1);",
       "multmatrix([[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Unable to convert mirror(5) parameter to a vec3 or vec2 of numbers in file "
       "<stdin>, line 1\n"},
      {"mirror([1e200,1,0]) cube(1);",
       "multmatrix([[nan, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"mirror([0,0,0]) cube(1);",
       "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"multmatrix([[1,2],[3]]) cube(1);",
       "multmatrix([[1, 2, 0, 0], [3, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"multmatrix([[1,2,3,4],[5,6,7,8],[9,10,11,12],[13,14,15,2]]) cube(1);",
       "multmatrix([[0.5, 1, 1.5, 2], [2.5, 3, 3.5, 4], [4.5, 5, 5.5, 6], [6.5, 7, 7.5, 1]]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
  });
}

TEST(BuiltinModules, MakeColors) {
  expect_each({
      {"color(\"Red\",0.5) cube(1);",
       "color([1, 0, 0, 0.5]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"color(\"NoSuch\") cube(1);",
       "color([-1, -1, -1, 1]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Unable to parse color \"nosuch\" in file <stdin>, line 1\n"
       "Please see https://en.wikipedia.org/wiki/Web_colors\n"},
      {"color(\"#F00a\") cube(1);",
       "color([1, 0, 0, 0.666667]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"color(\"#ff80008\") cube(1);",
       "color([-1, -1, -1, 1]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: Unable to parse color \"#ff80008\" in file <stdin>, line 1\n"
       "Please see https://en.wikipedia.org/wiki/Web_colors\n"},
      {"color([1,0]) cube(1);",
       "color([1, 0, 1, 1]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"color([2,-1,0.5]) cube(1);",
       "color([2, -1, 0.5, 1]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: color() expects numbers between 0.0 and 1.0. Value of 2.0 is out of range in file "
       "<stdin>, line 1\n"
       "WARNING: color() expects numbers between 0.0 and 1.0. Value of -1.0 is out of range in "
       "file <stdin>, line 1\n"},
      {"color([0.1,undef,[1]],\"x\") cube(1);",
       "color([0.1, 0, 0, 1]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"color(alpha=0.5) cube(1);",
       "color([-1, -1, -1, 0.5]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
      {"color(\"transparent\") cube(1);",
       "color([0, 0, 0, 0]) {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       ""},
  });
}

TEST(BuiltinModules, MakeExtrusions) {
  expect_each({
      {"linear_extrude(5);",
       "linear_extrude(height = 5, center = false, convexity = 1, scale = [1, 1], $fn = 0, $fa = "
       "12, $fs = 2);\n",
       ""},
      {"i = 7; linear_extrude(i) { i = 5; }",
       "linear_extrude(height = 5, center = false, convexity = 1, scale = [1, 1], $fn = 0, $fa = "
       "12, $fs = 2);\n",
       ""},
      {"linear_extrude(height=5,center=true,twist=30,slices=4,scale=2,convexity=3);",
       "linear_extrude(height = 5, center = true, convexity = 3, twist = 30, slices = 4, scale = "
       "[2, 2]);\n",
       ""},
      {"linear_extrude(height=-5,scale=[-1,2]);",
       "linear_extrude(height = 0, center = false, convexity = 1, scale = [0, 2], $fn = 0, $fa = "
       "12, $fs = 2);\n",
       ""},
      {"linear_extrude(origin=[1,\"a\"]);",
       "linear_extrude(height = 100, center = false, convexity = 1, scale = [1, 1], $fn = 0, $fa = "
       "12, $fs = 2);\n",
       "WARNING: linear_extrude(..., origin=[1, \"a\"]) could not be converted in file <stdin>, "
       "line 1\n"
       "WARNING: linear_extrude(..., scale=undef) could not be converted in file <stdin>, line "
       "1\n"},
      {"linear_extrude(scale=\"a\",slices=0.5,twist=1/0);",
       "linear_extrude(height = 100, center = false, convexity = 1, scale = [1, 1], $fn = 0, $fa = "
       "12, $fs = 2);\n",
       ""},
      {"linear_extrude(file=\"nofile.dxf\",layer=\"x\\\"\\n\",origin=[1,2],height=4) cube(1);",
       "linear_extrude(file = \"nofile.dxf\", layer = \"x\\\"\\n\", origin = [1, 2], timestamp = "
       "0, height = 4, center = false, convexity = 1, scale = [1, 1], $fn = 0, $fa = 12, $fs = "
       "2);\n",
       "DEPRECATED: Support for reading files in linear_extrude will be removed in future "
       "releases. Use a child import() instead.\n"
       "WARNING: linear_extrude(..., scale=undef) could not be converted in file <stdin>, line "
       "1\n"},
      {"linear_extrude(file=5);",
       "linear_extrude(height = 100, center = false, convexity = 1, scale = [1, 1], $fn = 0, $fa = "
       "12, $fs = 2);\n",
       ""},
      {"linear_extrude(\"5\");",
       "linear_extrude(file = \"5\", layer = \"\", origin = [0, 0], timestamp = 0, height = 100, "
       "center = false, convexity = 1, scale = [1, 1], $fn = 0, $fa = 12, $fs = 2);\n",
       "DEPRECATED: Support for reading files in linear_extrude will be removed in future "
       "releases. Use a child import() instead.\n"},
      {"rotate_extrude();",
       "rotate_extrude(angle = 360, convexity = 2, $fn = 0, $fa = 12, $fs = 2);\n", ""},
      {"rotate_extrude(90);",
       "rotate_extrude(file = \"90\", layer = \"\", origin = [0, 0], scale = 1, timestamp = 0, "
       "angle = 360, convexity = 2, $fn = 0, $fa = 12, $fs = 2);\n",
       "DEPRECATED: Support for reading files in rotate_extrude will be removed in future "
       "releases. Use a child import() instead.\n"},
      {"rotate_extrude(angle=-360,convexity=-1);",
       "rotate_extrude(angle = 360, convexity = 2, $fn = 0, $fa = 12, $fs = 2);\n", ""},
      {"rotate_extrude(angle=-90,$fn=5);",
       "rotate_extrude(angle = -90, convexity = 2, $fn = 5, $fa = 12, $fs = 2);\n", ""},
      {"dxf_linear_extrude(height=3) square(1);",
       "linear_extrude(height = 3, center = false, convexity = 1, scale = [1, 1], $fn = 0, $fa = "
       "12, $fs = 2) {\n"
       "\tsquare(size = [1, 1], center = false);\n"
       "}\n",
       "DEPRECATED: The dxf_linear_extrude() module will be removed in future releases. Use "
       "linear_extrude() instead. in file <stdin>, line 1\n"},
  });
}

TEST(BuiltinModules, MakeOperations) {
  expect_each({
      {"projection(true);", "projection(cut = true, convexity = 0);\n", ""},
      {"projection(convexity=1e10);", "projection(cut = false, convexity = -2147483648);\n", ""},
      {"offset(r=\"a\",delta=1,chamfer=true);",
       "offset(delta = 1, chamfer = true, $fn = 0, $fa = 12, $fs = 2);\n", ""},
      {"offset(delta=\"a\");", "offset(r = 1, $fn = 0, $fa = 12, $fs = 2);\n", ""},
      {"offset(2,$fs=0.0001);", "offset(r = 2, $fn = 0, $fa = 12, $fs = 0.0001);\n", ""},
      {"hull(foo=1) cube(1);",
       "hull() {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "}\n",
       "WARNING: variable foo not specified as parameter in file <stdin>, line 1\n"},
      {"minkowski(-1);", "minkowski(convexity = 4294967295);\n", ""},
      {"render(\"a\");", "render(convexity = 1);\n", ""},
      {"render(-5);", "render(convexity = -5);\n", ""},
      {"resize([1,\"a\",3],auto=[true,0,\"a\"],convexity=-3);",
       "resize(newsize = [1,0,3], auto = [1,0,1], convexity = 4294967293);\n", ""},
      {"resize([1e6,1e-5,123456.5],true);",
       "resize(newsize = [1e+06,1e-05,123456], auto = [1,1,1], convexity = 0);\n", ""},
  });
}

TEST(BuiltinModules, MakeFiles) {
  expect_each({
      {"import(\"nofile.stl\");",
       "import(file = \"nofile.stl\", layer = \"\", origin = [0, 0], scale = 1, convexity = 1, $fn "
       "= 0, $fa = 12, $fs = 2, timestamp = 0);\n",
       ""},
      {"import(filename=\"no.dxf\",layername=\"l\");",
       "import(file = \"no.dxf\", layer = \"l\", origin = [0, 0], scale = 1, convexity = 1, $fn = "
       "0, $fa = 12, $fs = 2, timestamp = 0);\n",
       "DEPRECATED: filename= is deprecated. Please use file=\n"
       "DEPRECATED: layername= is deprecated. Please use layer=\n"},
      {"import(\"no.svg\",center=true,dpi=96,scale=0,convexity=-4);",
       "import(file = \"no.svg\", layer = \"\", origin = [0, 0], center = true, dpi = 96, scale = "
       "1, convexity = 1, $fn = 0, $fa = 12, $fs = 2, timestamp = 0);\n",
       ""},
      {"import(\"no.svg\",dpi=0);",
       "import(file = \"no.svg\", layer = \"\", origin = [0, 0], center = false, dpi = 72, scale = "
       "1, convexity = 1, $fn = 0, $fa = 12, $fs = 2, timestamp = 0);\n",
       "WARNING: Invalid dpi value giving, using default of undef dpi. Value must be positive and "
       ">= 0.001, file <stdin>, import() at line <stdin>\n"},
      {"import(\"no.dxf\",origin=5);",
       "import(file = \"no.dxf\", layer = \"\", origin = [0, 0], scale = 1, convexity = 1, $fn = "
       "0, $fa = 12, $fs = 2, timestamp = 0);\n",
       "WARNING: linear_extrude(..., origin=5) could not be converted in file <stdin>, line 1\n"},
      {"import(\"sub/../no.stl\");",
       "import(file = \"no.stl\", layer = \"\", origin = [0, 0], scale = 1, convexity = 1, $fn = "
       "0, $fa = 12, $fs = 2, timestamp = 0);\n",
       ""},
      {"import();",
       "import(file = \"\", layer = \"\", origin = [0, 0], scale = 1, convexity = 1, $fn = 0, $fa "
       "= 12, $fs = 2, timestamp = 0);\n",
       ""},
      {"import_stl(\"no.svg\");",
       "import(file = \"no.svg\", layer = \"\", origin = [0, 0], scale = 1, convexity = 1, $fn = "
       "0, $fa = 12, $fs = 2, timestamp = 0);\n",
       "DEPRECATED: The import_stl() module will be removed in future releases. Use import() "
       "instead. in file <stdin>, line 1\n"},
      {"import_dxf(\"no.svg\",dpi=3);",
       "import(file = \"no.svg\", layer = \"\", origin = [0, 0], scale = 1, convexity = 1, $fn = "
       "0, $fa = 12, $fs = 2, timestamp = 0);\n",
       "DEPRECATED: The import_dxf() module will be removed in future releases. Use import() "
       "instead. in file <stdin>, line 1\n"},
      {"surface(\"no.png\",true,invert=true);",
       "surface(file = \"no.png\", center = true, invert = true, timestamp = 0);\n", ""},
      {"surface(5) cube(1);",
       "surface(file = \"5\", center = false, invert = false, timestamp = 0);\n", ""},
  });
}

TEST(CsgWriter, WritesModifiersAndRoots) {
  expect_each({
      {"%group(); #group() {}",
       "%group();\n"
       "#group();\n",
       ""},
      {"#%union() {cube(1); %translate([1,1,1]) cube(2);}",
       "%#union() {\n"
       "\tcube(size = [1, 1, 1], center = false);\n"
       "%\tmultmatrix([[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [0, 0, 0, 1]]) {\n"
       "\t\tcube(size = [2, 2, 2], center = false);\n"
       "\t}\n"
       "}\n",
       ""},
      {"cube(1); translate([1,1,1]) !sphere(2); union() {!cube(3);}",
       "sphere($fn = 0, $fa = 12, $fs = 2, r = 2);\n",
       "WARNING: More than one Root Modifier (!) in file <stdin>, line 1\n"},
      {"!%#union() {#cube(1); !cube(4);}",
       "union() {\n"
       "#\tcube(size = [1, 1, 1], center = false);\n"
       "\tcube(size = [4, 4, 4], center = false);\n"
       "}\n",
       "WARNING: More than one Root Modifier (!) in file <stdin>, line 1\n"},
      {"for(i=[0:1]) !cube(1);", "cube(size = [1, 1, 1], center = false);\n", ""},
      {"if(true);", "group();\n", ""},
      {";", "", ""},
  });
}

}  // namespace
