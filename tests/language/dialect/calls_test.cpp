// Scopes and calls of 2026's dialect beside those of 2021.01. What 2026 says and makes was found by
// running OpenSCAD 2025.07.18.
#include <gmock/gmock.h>

#include "dialect/said.hpp"

namespace language {
namespace {

constexpr const char* kEcho = "e = function(x) echo(x) x;\n";

TEST(Calls, EvaluateArgumentsAsWrittenAndThenDefaults) {
  const std::string program = kEcho + std::string(
                                          "function f(a = e(8), b = e(9)) = [a, b];\n"
                                          "x = f(b = e(1), zz = e(2));");
  EXPECT_EQ(said_2026(program),
            "ECHO: 1\nECHO: 2\n"
            "WARNING: variable \"zz\" not specified as parameter in file design.scad, line 3\n"
            "ECHO: 8\n");
  EXPECT_EQ(said_2021(program).substr(0, 16), "ECHO: 8\nECHO: 9\n");
}

TEST(Calls, FillFreeParameters) {
  const std::string define = "function f(a, b, c) = [a, b, c];\n";
  EXPECT_EQ(said_2026(define + "echo(f(a = 1, 2), f(b = 1, 2, 3));"),
            "ECHO: [1, 2, undef], [2, 1, 3]\n");
  EXPECT_EQ(said_2026(define + "echo(f(1, a = 2));"),
            "WARNING: argument \"a\" overrides positional argument in file design.scad, line 2\n"
            "ECHO: [2, undef, undef]\n");
  EXPECT_EQ(said_2026(define + "echo(f(a = 1, a = 2));"),
            "WARNING: argument \"a\" supplied more than once in file design.scad, line 2\n"
            "ECHO: [2, undef, undef]\n");
  EXPECT_EQ(said_2021(define + "echo(f(a = 1, 2));"), "ECHO: [2, undef, undef]\n");
}

TEST(Calls, GiveEachParameterOfANameAnArgument) {
  const std::string program = "function f(p, p, q) = [p, q]; echo(f(1, 2, 3), f(p = 1, 2));";
  EXPECT_EQ(said_2026(program), "ECHO: [2, 3], [1, 2]\n");
}

TEST(Calls, EvaluateLeftOperandsFirst) {
  const std::string program =
      kEcho + std::string("x = e(1) + e(2) * e(3); y = e([4])[e(0)]; z = e(5) < e(6);");
  EXPECT_EQ(said_2026(program),
            "ECHO: 1\nECHO: 2\nECHO: 3\nECHO: [4]\nECHO: 0\nECHO: 5\nECHO: 6\n");
  EXPECT_EQ(said_2021(program),
            "ECHO: 3\nECHO: 2\nECHO: 1\nECHO: 0\nECHO: [4]\nECHO: 6\nECHO: 5\n");
}

TEST(Calls, SeeNoDynamicNamesOfUsedFiles) {
  const BesideFiles files = {{"used.scad",
                              "$g = 1;\nx = $g;\nfunction g() = [x, $g];\n"
                              "module m() echo($g);\n"}};
  const std::string program = "use <used.scad>\n$g = 5;\necho(g());\nm();\n";
  EXPECT_EQ(said_2026(program, files), "ECHO: [1, 5]\nECHO: 5\n");
  EXPECT_EQ(said_2021(program, files), "ECHO: [1, 1]\nECHO: 1\n");
  EXPECT_EQ(said_2026("use <used.scad>\nm();\n", files),
            "WARNING: Ignoring unknown variable \"$g\" in file used.scad, line 4\nECHO: undef\n");
}

TEST(Calls, BindDynamicNamesAfterAllElse) {
  EXPECT_EQ(said_2026("$p = 9; function f($p = 1, q = $p) = [$p, q]; echo(f(), f(2));"),
            "ECHO: [1, 9], [2, 9]\n");
  EXPECT_EQ(said_2021("$p = 9; function f($p = 1, q = $p) = [$p, q]; echo(f(), f(2));"),
            "ECHO: [1, 1], [2, 1]\n");
  EXPECT_EQ(said_2026("$y = 1; function f(a = $y) = [a, $y]; echo(f($y = 2), f($y, $y = 3));"),
            "ECHO: [1, 2], [1, 3]\n");
  EXPECT_EQ(tree_2026("$y = 1; translate([$y, 0, 0], $y = 3) cube($y);"),
            "multmatrix([[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
            "\tcube(size = [3, 3, 3], center = false);\n}\n\n");
}

TEST(Calls, EvaluateBlocksWhenChildrenAre) {
  const std::string program =
      kEcho + std::string(
                  "module m(a) { echo(\"m\", a); children(); children(); }\n"
                  "x = 9; m(x) { x = e(1); echo(x); }");
  EXPECT_EQ(said_2026(program), "ECHO: \"m\", 9\nECHO: 1\nECHO: 1\nECHO: 1\nECHO: 1\n");
  EXPECT_EQ(said_2021(program), "ECHO: 1\nECHO: \"m\", 1\nECHO: 1\nECHO: 1\n");
  EXPECT_EQ(said_2026("module m() { $z = 1; children([0, 1], $z = 4); }\n"
                      "m() { a = echo(\"block\") $z; echo(a); echo(-a); }"),
            "ECHO: \"block\"\nECHO: 4\nECHO: -4\n");
}

TEST(Calls, ChildrenAlwaysMakeAGroup) {
  const std::string program = "module m() { %children(0); } m() cube(1);";
  EXPECT_EQ(tree_2026(program),
            "group() {\n%\tgroup() {\n\t\tcube(size = [1, 1, 1], center = false);\n\t}\n}\n\n");
  EXPECT_EQ(tree_2021(program), "group() {\n\tcube(size = [1, 1, 1], center = false);\n}\n\n");
  EXPECT_EQ(said_2026("module m() { children(3); children(-1); } m() cube(1);"),
            "WARNING: Children index (3) out of bounds (1 children) in file design.scad, line 1\n"
            "WARNING: Children index (-1) out of bounds (1 children) in file design.scad, line "
            "1\n");
  EXPECT_EQ(said_2026("union(3) cube(1);"),
            "WARNING: Too many unnamed arguments supplied in file design.scad, line 1\n");
  EXPECT_EQ(said_2021("union(3) cube(1);"), "");
}

TEST(Calls, ChildrenAreAModuleLikeOthers) {
  const std::string program = "children(echo(\"evaluated\") 0) cube(1);";
  EXPECT_EQ(
      said_2026(program),
      "ECHO: \"evaluated\"\nWARNING: module children() does not support child modules in file "
      "design.scad, line 1\n");
  EXPECT_EQ(said_2021(program), "");
}

TEST(Calls, CountModulesBehindArgumentsAndDefaults) {
  const std::string program =
      "module m(a, b = $parent_modules) { echo(a, b, $parent_modules); children(); }\n"
      "m() m($parent_modules);";
  EXPECT_EQ(said_2026(program),
            "WARNING: Ignoring unknown variable \"$parent_modules\" in file design.scad, line 1\n"
            "ECHO: undef, undef, 1\nECHO: 1, 1, 2\n");
  EXPECT_EQ(said_2021(program), "ECHO: undef, 1, 1\nECHO: 2, 2, 2\n");
}

TEST(Calls, CallDynamicNamesAndLetTheInnermostNameCount) {
  EXPECT_EQ(said_2026("$f = function(x) x + 1; echo($f(1));"), "ECHO: 2\n");
  EXPECT_EQ(said_2026("function g() = let(g = function() 5) g(); echo(g());"), "ECHO: 5\n");
  EXPECT_EQ(said_2026("function h(h) = h(1); echo(h(function(x) x + 10));"), "ECHO: 11\n");
}

TEST(Calls, FindFunctionsOfOuterVariables) {
  const std::string program =
      "f = function(x) x + 1; module m(f) { echo(f(1)); union() echo(let(f = undef) f(2)); }\n"
      "m(3); function g(f) = f(3); echo(g(3), [for (f = [1]) f(4)]);";
  EXPECT_EQ(said_2026(program), "ECHO: 2\nECHO: 3\nECHO: 4, [5]\n");
  EXPECT_NE(said_2021(program), said_2026(program));
}

TEST(Calls, AllCallsInTailPositionLoop) {
  EXPECT_EQ(said_2026("function even(n) = n == 0 ? true : odd(n - 1);\n"
                      "function odd(n) = n == 0 ? false : even(n - 1);\necho(even(900000));"),
            "ECHO: true\n");
  EXPECT_EQ(said_2026("f = function(n) n == 0 ? \"end\" : f(n - 1); echo(f(900000));"),
            "ECHO: \"end\"\n");
  EXPECT_EQ(
      said_2026(
          "$d = 0; function t(n, d = $d) = n == 0 ? d : t(n - 1, $d = n); echo(t(3, $d = 7));"),
      "ECHO: 2\n");
}

TEST(Calls, RoundsHaveTheirOwnVariables) {
  const std::string program =
      "f = [for (i = [0:2]) function() i]; echo(f[0](), f[1](), f[2]());\n"
      "g = [for (a = 0; a < 3; a = a + 1) function() a]; echo(g[0](), g[2]());";
  EXPECT_EQ(said_2026(program), "ECHO: 0, 1, 2\nECHO: 0, 2\n");
  EXPECT_EQ(said_2021(program), "ECHO: 2, 2, 2\nECHO: 3, 3\n");
  EXPECT_EQ(said_2026("echo([for ($x = 0; $x < 2; $x = $x + 1) $x]);"), "ECHO: [0, 1]\n");
}

TEST(Calls, TraceAssignmentsAndParameters) {
  EXPECT_EQ(said_2026("module m(x, y = 2) {\n  echo(assert(x > 3) 1);\n}\nfunction f(x) =\n"
                      "  assert(false);\nm(3, $q = 1);\n"),
            "ERROR: Assertion '(x > 3)' failed in file design.scad, line 2\n"
            "TRACE: called by 'echo' in file design.scad, line 2\n"
            "TRACE: call of 'm(x = 3, y = 2)' in file design.scad, line 1\n"
            "TRACE: called by 'm' in file design.scad, line 6\n");
  EXPECT_EQ(said_2026("module m(x) {\n  a = assert(false);\n}\nm(3);\n"),
            "ERROR: Assertion 'false' failed in file design.scad, line 2\n"
            "TRACE: assignment to \"a\" in file design.scad, line 2\n"
            "TRACE: called by 'm' in file design.scad, line 4\n");
  EXPECT_THAT(said_2026("module m(x) { x = floor(1.5); assert(false); }\nm(3);\n"),
              testing::HasSubstr("TRACE: call of 'm(x = 1)'"))
      << "what the parameter holds by now";
  EXPECT_THAT(said_2026("module m($a, b, b) { assert(false); }\nm(1, 2);\n"),
              testing::HasSubstr("TRACE: call of 'm($a = 1, b = 2, b = 2)'"));
  EXPECT_THAT(
      said_2026("a = 1;\na = 2;\na = assert(false);\n"),
      testing::EndsWith("TRACE: overwritten assignment to \"a\" (this is where the "
                        "assignment is evaluated) in file design.scad, line 1\n"
                        "TRACE: overwriting assignment to \"a\" in file design.scad, line 3\n"));
}

TEST(Calls, OfAStringOfSeveralLinesAreWhereItEnds) {
  const std::string text = "a = \"x\ny\n\" + 1;\nb = 1 + \"\n\";\n";
  for (const std::string& said : {said_2021(text), said_2026(text)}) {
    EXPECT_EQ(said,
              "WARNING: undefined operation (string + number) in file design.scad, line 3\n"
              "WARNING: undefined operation (number + string) in file design.scad, line 4\n");
  }
}

TEST(Calls, SayIn2026sWords) {
  EXPECT_EQ(said_2026("echo(q);"),
            "WARNING: Ignoring unknown variable \"q\" in file design.scad, line 1\nECHO: undef\n");
  EXPECT_EQ(said_2026("module m(a) { a = 1; } m(2);"),
            "WARNING: Parameter \"a\" is overwritten with a literal in file design.scad, line 1\n");
  EXPECT_EQ(said_2026("assert();").substr(0, 24), "ERROR: Assertion failed ");
}

}  // namespace
}  // namespace language
