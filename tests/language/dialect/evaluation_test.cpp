// What an evaluation of 2026's dialect begins with, how it ends, and lazy unions, beside 2021.01.
// What 2026 says and makes was found by running OpenSCAD 2025.07.18; colours of the XKCD survey,
// $fe and em are those of July 2026.
#include <gmock/gmock.h>

#include "dialect/said.hpp"
#include "language/customizer.hpp"

namespace language {
namespace {

Said said_with(const std::string& program, const EvaluationOptions& options) {
  return evaluated(program, options);
}

std::string lazy_tree(const std::string& program) {
  EvaluationOptions options = in_language(LanguageVersion::k2026);
  options.lazy_union = true;
  return said_with(program, options).tree;
}

TEST(Camera, IsTheCommandLines) {
  const std::string program = "echo($vpt, $vpr, $vpd, $vpf);";
  EXPECT_EQ(said_2026(program), "ECHO: [0, 0, 0], [55, 0, 25], 140, 22.5\n");
  EXPECT_EQ(said_2021(program), "ECHO: [0, 0, 0], [0, 0, 0], 500, 22.5\n");
  EvaluationOptions options = in_language(LanguageVersion::k2026);
  options.view = {{1, 2, 3}, {370, -50, 400}, 0};
  EXPECT_EQ(said_with(program, options).messages, "ECHO: [1, 2, 3], [10, 310, 40], 0, 22.5\n");
  options.language = LanguageVersion::k2021;
  EXPECT_EQ(said_with(program, options).messages, "ECHO: [0, 0, 0], [0, 0, 0], 500, 22.5\n");
}

TEST(Aborted, KeepsWhatHasEnded) {
  const std::string program = "hull(); translate([1,2,3]) { hull(); assert(false); } hull();";
  EXPECT_EQ(tree_2026(program), "hull();\n\n");
  EXPECT_EQ(tree_2021(program), "\n");
}

TEST(LazyUnion, MakesNoGroups) {
  const std::string loop = "for (i = [1, 2]) hull();";
  EXPECT_EQ(lazy_tree(loop), "hull();\nhull();\n\n");
  EXPECT_EQ(tree_2026(loop), "group() {\n\thull();\n\thull();\n}\n\n");
  EXPECT_EQ(lazy_tree("if (true) { hull(); } let (a = 1) hull(); echo() hull();"),
            "hull();\nhull();\nhull();\n\n");
  EXPECT_EQ(lazy_tree("module m() children(); m() { hull(); hull(); }"),
            "group() {\n\thull();\n\thull();\n}\n\n");
  EXPECT_EQ(lazy_tree("union() for (i = []) hull();"), "union() {\n}\n\n");
  EXPECT_EQ(lazy_tree("#for (i = [1]) union() hull();"), "#union() {\n#\thull();\n}\n\n");
  EvaluationOptions old = in_language(LanguageVersion::k2021);
  old.lazy_union = true;
  EXPECT_EQ(said_with(loop, old).tree, tree_2021(loop));
}

TEST(Traces, TellTheLastCallInTailPosition) {
  const std::string traced =
      "function g(p) = p > 3 ? assert(false) 1 : g(p + 1);\n"
      "function h(p) = g(p);\n"
      "echo(h(1));";
  EXPECT_EQ(said_2026(traced),
            "ERROR: Assertion 'false' failed in file design.scad, line 1\n"
            "TRACE: called by 'g' in file design.scad, line 1\n"
            "TRACE: called by 'echo' in file design.scad, line 3\n");
}

TEST(Traces, ShowParametersOfModules) {
  const std::string program = "module m(s, v = [\"q\\\"\"]) assert(false);\nm(\"a\\\"b\\n\");";
  const std::string first =
      "ERROR: Assertion 'false' failed in file design.scad, line 1\n"
      "TRACE: called by 'assert' in file design.scad, line 1\n";
  const std::string parameters =
      "TRACE: call of 'm(s = \"a\\\"b\\n\", v = [\"q\"\"])' in file design.scad, line 1\n";
  const std::string last = "TRACE: called by 'm' in file design.scad, line 2\n";
  EXPECT_EQ(said_2026(program), first + parameters + last);
  EvaluationOptions options = in_language(LanguageVersion::k2026);
  options.traces.has_parameters = false;
  EXPECT_EQ(said_with(program, options).messages, first + last);
  options.traces.most_lines = 1;
  EXPECT_EQ(said_with(program, options).messages, first);
}

TEST(Nodes, OfJuly2026) {
  EXPECT_EQ(tree_2026("color(\"xkcd:Dust\") hull();"),
            "color([0.698039, 0.6, 0.431373, 1]) {\n\thull();\n}\n\n");
  EXPECT_EQ(said_2021("color(\"xkcd:dust\") hull();").substr(0, 8), "WARNING:");
  EXPECT_EQ(tree_2026("circle(1, $fe = 0.1);"),
            "circle($fn = 0, $fa = 12, $fs = 2, $fe = 0.1, r = 1);\n\n");
  EXPECT_EQ(tree_2021("circle(1, $fe = 0.1);"), "circle($fn = 0, $fa = 12, $fs = 2, r = 1);\n\n");
  EXPECT_EQ(tree_2026("text(em = 50);"), tree_2026("text(size = 36);"));
}

TEST(Drawings, TakeUnnamedArguments) {
  const auto warned = [](const std::string& text) {
    return "WARNING: " + text + " in file design.scad, line 1\n";
  };
  const std::string missing = warned("Can't open DXF file 'x.dxf'!");
  EXPECT_EQ(said_2026("x = dxf_dim(\"x.dxf\", \"l\", \"n\");"),
            warned("dxf_dim(..., origin=\"n\") could not be converted") + missing);
  EXPECT_EQ(said_2026("x = dxf_cross(file = \"x.dxf\", foo = 1);"),
            warned("variable \"foo\" not specified as parameter") + missing);
  EXPECT_EQ(said_2026("x = dxf_cross(\"x.dxf\", 1, [1, 2], 3, 4, 5);"),
            warned("Too many unnamed arguments supplied") + missing);
}

TEST(Parser, NestsDeeperThan2021) {
  const auto nested = [](size_t depth) {
    return "echo(" + std::string(depth, '(') + "1" + std::string(depth, ')') + ");";
  };
  EXPECT_EQ(said_2026(nested(90'000)), "ECHO: 1\n");
  EXPECT_NE(said_2026(nested(210'000)).find("memory exhausted"), std::string::npos);
  EXPECT_NE(said_2021(nested(30'000)).find("memory exhausted"), std::string::npos);
}

// What users of the snapshots of 2026 report shows it; 2025.07.18 for node shows whole paths.
TEST(Paths, AreShownFromTheMainFilesFolder) {
  const BesideFiles files = {{"sub/lib.scad", "include <more.scad>\nmodule m() cube(b = 1);"},
                             {"sub/more.scad", "module n() { echo(1 + \"a\"); m(); }"}};
  const std::string program = "use <sub/lib.scad>\nn();";
  EXPECT_EQ(said_2026(program, files),
            "WARNING: undefined operation (number + string) in file sub/more.scad, line 1\n"
            "ECHO: undef\n"
            "WARNING: variable \"b\" not specified as parameter in file sub/lib.scad, line 2\n");
  EXPECT_EQ(said_2021(program, files),
            "WARNING: undefined operation (number + string) in file more.scad, line 1\n"
            "ECHO: undef\n"
            "WARNING: variable b not specified as parameter in file lib.scad, line 2\n");
  const BesideFiles nested = {{"sub/lib.scad", "use <used.scad>"},
                              {"sub/used.scad", "a = 1;\na = 2;"}};
  const auto path_of = [](const std::string& said) { return said.substr(said.rfind(" in file ")); };
  EXPECT_EQ(path_of(said_2026("use <sub/lib.scad>", nested)), " in file sub/used.scad, line 2\n");
  EXPECT_EQ(path_of(said_2021("use <sub/lib.scad>", nested)), " in file used.scad, line 2\n");
}

TEST(Parameters, AreWrittenAsJson) {
  const auto parameters = customizer_parameters(
      "// width of it\nwidth = 10; // [1:20]\n/* [A] */\ns = \"x\"; // [x:Ex, y]\nname = \"n\"; // "
      "8\n"
      "v = [1, 2]; // [0:0.5:10]\nfive = [1, 2, 3, 4, 5];\n/* [Hidden] */\nh = 3;\n",
      LanguageVersion::k2026);
  ASSERT_TRUE(parameters);
  EXPECT_EQ(
      parameters_text(*parameters, "design"),
      R"({"parameters":[{"caption":"width of it","group":"Parameters","initial":10.0,"max":20.0,)"
      R"("min":1.0,"name":"width","step":1.0,"type":"number"},)"
      R"({"group":"A","initial":"x","name":"s","options":[{"name":"Ex","value":"x"},)"
      R"({"name":"y","value":"y"}],"type":"string"},)"
      R"({"group":"A","initial":"n","maxLength":8,"name":"name","type":"string"},)"
      R"({"group":"A","initial":[1.0,2.0],"max":10.0,"min":0.0,"name":"v","step":0.5,)"
      R"("type":"number"}],"title":"design"})");
}

TEST(Parameters, HaveARangeThatHoldsTheDefault) {
  const auto expect = [](const std::string& assignment, const std::string& limits) {
    const auto parameters = customizer_parameters("x = " + assignment, LanguageVersion::k2026);
    ASSERT_TRUE(parameters) << assignment;
    EXPECT_THAT(parameters_text(*parameters, "design"), testing::HasSubstr(limits)) << assignment;
  };
  expect("5; // [5:1]", R"("max":5.0,"min":5.0,"name":"x","step":1.0)");
  expect("5; // [1:-1:-5]", R"("max":5.0,"min":1.0,"name":"x","step":-1.0)");
  expect("-3; // [0:10]", R"("max":10.0,"min":-3.0,"name":"x","step":1.0)");
  expect("-3; // [10]", R"("max":10.0,"min":0.0,"name":"x","step":1.0)");
  expect("[1, 20]; // [3:0:10]", R"("max":20.0,"min":1.0,"name":"x","step":0.0)");
  expect("5; // [1:2:3:4]", R"("initial":5.0,"name":"x","type")");
  expect("\"a\"; // [1:10]", R"("initial":"a","name":"x","type")");
  expect("\"a\"; // -3", R"("maxLength":0)");
}

TEST(Parameters, HaveTheDefaultAmongTheirChoices) {
  const auto expect = [](const std::string& assignment, const std::string& options) {
    const auto parameters = customizer_parameters("x = " + assignment, LanguageVersion::k2026);
    ASSERT_TRUE(parameters) << assignment;
    EXPECT_THAT(parameters_text(*parameters, "design"),
                testing::HasSubstr("\"options\":[" + options + "]"))
        << assignment;
  };
  expect("1234567; // [1:a]",
         R"({"name":"1.23457e+06","value":1234567.0},{"name":"a","value":1.0})");
  expect("\"1\"; // [1, b]",
         R"({"name":"1","value":"1"},{"name":"1","value":1.0},{"name":"b","value":"b"})");
  expect("2; // [a, 2]", R"({"name":"a","value":"a"},{"name":"2","value":2.0})");
}

}  // namespace
}  // namespace language
