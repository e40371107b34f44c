// Modules of 2026's dialect, and the text of their nodes, beside those of 2021.01. What 2026 says
// and makes was found by running OpenSCAD 2025.07.18.
#include "dialect/said.hpp"

namespace language {
namespace {

/// Expects the node of a call, without the line ends behind it.
void expect_node(const std::string& call, const std::string& node) {
  EXPECT_EQ(tree_2026(call + ";"), node + ";\n\n") << call;
}

void expect_warning(const std::string& call, const std::string& text) {
  EXPECT_EQ(said_2026(call + ";"), "WARNING: " + text + " in file design.scad, line 1\n") << call;
}

constexpr const char* kFragments = "$fn = 0, $fa = 12, $fs = 2";

TEST(Modules, LinearExtrude) {
  const auto expect = [](const std::string& arguments, const std::string& node) {
    expect_node("linear_extrude(" + arguments + ")", "linear_extrude(" + node + ")");
  };
  const std::string fragments = std::string(", ") + kFragments;
  expect("5", "height = 5" + fragments);
  expect("h = 5, center = true", "height = 5, center = true" + fragments);
  expect("v = [3, 2, 5]", "height = 6.16441, v = [ 0.486664, 0.324443, 0.811107]" + fragments);
  expect("10, v = [0, 0, 1]", "height = 10" + fragments);
  expect("v = [0, 0, -2]", "height = 0" + fragments);
  expect("v = [1, 2, -3]", "height = 2.23607, v = [ 0.447214, 0.894427, 0]" + fragments);
  expect("-3, v = [1, 0, 0]", "height = 3, v = [ -1, -0, 0]" + fragments);
  expect("1e200", "height = inf, v = [ 0, 0, 0]" + fragments);
  expect("5, convexity = 1 / 0", "height = 5" + fragments);
  expect("5, convexity = 3e9", "height = 5" + fragments + ", convexity = 3000000000");
  expect("5, scale = 2", "height = 5, scale = 2" + fragments);
  expect("5, scale = [2, 3]", "height = 5, scale = [2, 3]" + fragments);
  expect("5, segments = 0, convexity = 10",
         "height = 5, segments = 0" + fragments + ", convexity = 10");
  expect("5, slices = 2, segments = 3, twist = 10",
         "height = 5, twist = 10, slices = 2, segments = 3");
  expect("5, [1, 2, 3], 2, true, 90, 8, 9",
         "height = 5, v = [ 0.267261, 0.534522, 0.801784], center = true, twist = 90, slices = 8, "
         "segments = 9, scale = 2");
  expect_warning("linear_extrude(segments = 1 / 0)",
                 "linear_extrude(..., segments=inf) argument cannot be infinite or nan");
  expect_warning("linear_extrude(height = 5, h = 6)", "Specified both \"height\" and \"h\"");
  expect_warning("linear_extrude(5, slices = true)",
                 "linear_extrude(..., slices=true) Invalid type: expected number, found bool");
  EXPECT_EQ(said_2026("linear_extrude(\"a\"); linear_extrude(v = 1);"),
            "ERROR: height when specified should be a number.\n"
            "ERROR: v when specified should be a 3d vector.\n");
  expect_warning("linear_extrude(5, slices = 1 / 0)",
                 "linear_extrude(..., slices=inf) argument cannot be infinite or nan");
  expect("5, segments = 0 / 0, slices = 2", "height = 5, slices = 2" + fragments);
  // A height turns a direction, which then stays above the plane of the figure.
  expect("-3, v = [1, 0, -1]", "height = 3, v = [ -0.707107, -0, 0.707107]" + fragments);
  expect("3, v = [0, 1, -1]", "height = 2.12132, v = [ 0, 1, 0]" + fragments);
  expect("-1, v = [1, 0, 0]", "height = 1, v = [ -1, -0, 0]" + fragments);
  expect("3, v = [0, 0, 0]", "height = 0" + fragments);
  expect("v = [1e-8, 0, 1]", "height = 1" + fragments);
  expect("-3", "height = 0" + fragments);
  // The numbers before the first element that is none count.
  expect("5, v = [1, [], 2]",
         "height = 5, v = [ 0.707107, 0, 0.707107], $fn = 0, $fa = 12, $fs = 2");
  EXPECT_THAT(said_2026("linear_extrude([1], h = 2, v = \"a\");"),
              testing::StartsWith("ERROR: v when specified should be a 3d vector.\n"
                                  "WARNING: Specified both"));
  EXPECT_EQ(tree_2021("linear_extrude(5);"),
            "linear_extrude(height = 5, center = false, convexity = 1, scale = [1, 1], $fn = 0, "
            "$fa = 12, $fs = 2);\n\n");
}

TEST(Modules, NegativeZerosOfRotations) {
  const auto expect = [](const std::string& call, const std::string& rows) {
    expect_node(call, "multmatrix([" + rows + ", [0, 0, 0, 1]])");
  };
  expect("rotate([0, 0, 180])", "[-1, 0, 0, 0], [-0, -1, 0, 0], [-0, 0, 1, 0]");
  expect("rotate([0, 270, 0])", "[0, 0, -1, 0], [0, 1, -0, 0], [1, 0, -0, 0]");
  expect("rotate([90, 90, 0])", "[0, 1, 0, 0], [0, 0, -1, 0], [-1, 0, 0, 0]");
  expect("rotate(140, [-1, 0, 0])",
         "[1, -0, 0, 0], [0, -0.766044, 0.642788, 0], [0, -0.642788, -0.766044, 0]");
  expect("translate([-0, 0, 0])", "[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]");
}

TEST(Modules, ConvertToTheNearestInteger) {
  for (const auto& [number, nearest] :
       {std::pair("1e10", "2147483647"), {"-1 / 0", "-2147483648"}, {"0 / 0", "0"}}) {
    const std::string call = std::string("render(") + number + ")";
    expect_node(call, std::string("render(convexity = ") + nearest + ")");
    EXPECT_EQ(tree_2021(call + ";"), "render(convexity = -2147483648);\n\n");
  }
  expect_node("linear_extrude(1, slices = 1e10, segments = 1)",
              "linear_extrude(height = 1, slices = 4294967295, segments = 1)");
}

TEST(Modules, RoofsHaveLeastFragments) {
  expect_node("roof($fa = 0, $fs = -1, convexity = -1)",
              "roof(method = \"voronoi\", $fa = 0.01, $fs = 0.01, $fn = 0, convexity = 1)");
  expect_node("roof($fn = 4, convexity = 1 / 0)",
              "roof(method = \"voronoi\", $fa = 90, $fs = 0, $fn = 4, convexity = 1)");
}

TEST(Modules, WithoutFragmentsDoNotCheckThem) {
  for (const char* const call : {"cube(1, $fs = 0);", "square(1, $fs = 0);"}) {
    EXPECT_EQ(said_2026(call), "");
    EXPECT_NE(said_2021(call), "");
  }
  expect_warning("sphere(1, $fs = 0)", "$fs too small - clamping to 0.010000");
}

TEST(Modules, RotateExtrude) {
  const auto expect = [](const std::string& arguments, const std::string& node) {
    expect_node("rotate_extrude(" + arguments + ")", "rotate_extrude(" + node + ")");
  };
  const std::string fragments = std::string(", convexity = 2, ") + kFragments;
  expect("", "angle = 360, start = 180" + fragments);
  expect("45", "angle = 45, start = 0" + fragments);
  expect("a = -45", "angle = -45, start = 0" + fragments);
  expect("angle = 360", "angle = 360, start = 0" + fragments);
  expect("start = 183, angle = 180", "angle = 180, start = 183" + fragments);
  expect("1, 2, 3", "angle = 1, start = 2, convexity = 3, $fn = 0, $fa = 12, $fs = 2");
  EXPECT_EQ(said_2026("rotate_extrude($fn = 5);").substr(0, 75),
            "DEPRECATED: In future releases, rotational extrusion without \"angle\" will s");
  EXPECT_EQ(said_2026("rotate_extrude($fn = 4);"), "");
  EXPECT_NE(said_2026("rotate_extrude($fn = -1);"), "");
}

TEST(Modules, TextsAndFiles) {
  expect_node(
      "text(\"a\")",
      "text(text = \"a\", size = 10, spacing = 1, font = \"\", direction = \"ltr\", language "
      "= \"en\", script = \"Latn\", halign = \"default\", valign = \"default\", $fn = 0, $fa "
      "= 12, $fs = 2)");
  expect_warning("text(5)", "text(..., text=5) Invalid type: expected string, found number");
  expect_node(
      "import(\"a.svg\", id = \"q\", layer = 5, center = true)",
      "import(file = \"a.svg\", id = \"q\", layer = \"5\", origin = [0, 0], dpi = 72, scale "
      "= 1, center = true, convexity = 1, $fn = 0, $fa = 12, $fs = 2, timestamp = 0)");
  expect_node("import(\"a.stl\")",
              "import(file = \"a.stl\", origin = [0, 0], scale = 1, center = false, convexity = 1, "
              "$fn = 0, $fa = 12, $fs = 2, timestamp = 0)");
  expect_warning("text(\"a\") cube()", "module text() does not support child modules");
}

TEST(Modules, ImportWritesTheIdAndLayerThatAreGiven) {
  const std::string rest =
      "origin = [0, 0], dpi = 72, scale = 1, center = true, convexity = 1, $fn = 0, $fa = 12, $fs "
      "= 2, timestamp = 0)";
  expect_node("import(\"no.svg\", id = \"\", layer = \"\", center = true)",
              "import(file = \"no.svg\", id = \"\", layer = \"\", " + rest);
  expect_node("import(\"no.svg\", id = undef, layer = undef, center = true)",
              "import(file = \"no.svg\", " + rest);
}

TEST(Modules, PointsAreChecked) {
  expect_node("polygon([[0, 0], [1, \"a\"], [-0, 1e-7]], [[0, 1, 5], 3])",
              "polygon(points = [[0, 0], [0, 0], [-0, 1e-07]], paths = [[0, 1]], convexity = 1)");
  EXPECT_EQ(
      said_2026("polygon([[0, 0], [1, \"a\"], [-0, 1e-7]], [[0, 1, 5], 3]);"),
      "ERROR: Unable to convert points[1] = [1, \"a\"] to a vec2 of numbers in file "
      "design.scad, line 1\n"
      "WARNING: Point index 5 is out of bounds (from paths[0][2]) in file design.scad, line 1\n"
      "ERROR: Unable to convert paths[1] = 3 to a vector of numbers in file design.scad, line "
      "1\n");
  expect_node("polygon()", "polygon(points = [], paths = undef, convexity = 1)");
  expect_node("polyhedron([[0, 0, 0], [1, 0], [0, 1, 0]], [[0, 1, 2], [0, 1]])",
              "polyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], faces = [[0, 1, 2]], "
              "convexity = 1)");
  expect_node("polyhedron(\"a\", [[0, 1, 2]])",
              "polyhedron(points = [], faces = [], convexity = 1)");
  expect_node("polyhedron([[0, 0, 0]], 3, convexity = 5)",
              "polyhedron(points = [[0, 0, 0]], faces = [], convexity = 1)");
  expect_node("polygon([[0, 0]], 3, convexity = 5)",
              "polygon(points = [[0, 0]], paths = undef, convexity = 1)");
  expect_node("polygon([[0, 0]], [[0 / 0]], convexity = 5)",
              "polygon(points = [[0, 0]], paths = [[0]], convexity = 5)");
  expect_warning("polygon([[0, 0]], [[1 / 0]])",
                 "Point index 4294967295 is out of bounds (from paths[0][0])");
}

TEST(Modules, FillRoofAndColor) {
  expect_node("fill()", "fill()");
  expect_node("roof(\"straight\", 2, $fn = 7)",
              "roof(method = \"straight\", $fa = 51.4286, $fs = 0, $fn = 7, convexity = 2)");
  expect_warning("roof(\"x\")", "Unknown roof method 'x'. Using 'voronoi'.");
  expect_node("color()", "color([-1, -1, -1, -1])");
  expect_warning("color(\"NoColor\")", "Unable to parse color \"NoColor\"");
  expect_warning("color(alpha = 3)",
                 "color() expects alpha between 0.0 and 1.0. Value of 3.0 is out of range");
  EXPECT_EQ(tree_2021("color();"), "color([-1, -1, -1, 1]);\n\n");
}

TEST(Modules, TakeAllParametersUnnamed) {
  expect_node("offset(1, 2, true)", "offset(r = 1, $fn = 0, $fa = 12, $fs = 2)");
  EXPECT_EQ(said_2026("projection(true, 2);"), "");
  EXPECT_EQ(said_2026("e = function(x) echo(x) 1; cube(e(1), e(2), e(3)) sphere();"),
            "ECHO: 1\nECHO: 2\nECHO: 3\n"
            "WARNING: module cube() does not support child modules in file design.scad, line 1\n"
            "WARNING: Too many unnamed arguments supplied in file design.scad, line 1\n");
}

TEST(Modules, MatricesAreWrittenByG) {
  expect_node("translate([100.0625, 1e-6, -0])",
              "multmatrix([[1, 0, 0, 100.062], [0, 1, 0, 1e-06], [0, 0, 1, 0], [0, 0, 0, 1]])");
  expect_node("mirror([1, 0, 0])",
              "multmatrix([[-1, -0, -0, 0], [-0, 1, -0, 0], [-0, -0, 1, 0], [0, 0, 0, 1]])");
  expect_warning("sphere(r = 1, d = 2)",
                 "Ignoring radius variable \"r\" as diameter \"d\" is defined too.");
}

TEST(Values, HaveMembersOfSeveralLetters) {
  EXPECT_EQ(said_2026("v = [1, 2, 3, 4]; echo(v.zwy, v.rgba, v.w, v.ra, v.xr, [1, 2].xyz, [1].y);"),
            "ECHO: [3, 4, 2], [1, 2, 3, 4], 4, [1, 4], undef, [1, 2, undef], undef\n");
  EXPECT_EQ(said_2021("echo([1, 2, 3, 4].xy);"), "ECHO: undef\n");
}

}  // namespace
}  // namespace language
