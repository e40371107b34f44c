// Errors with their traces, hard warnings, units (LANGUAGE.md, "Messages"). Expected texts are
// those of OpenSCAD 2021.01.
#include <gtest/gtest.h>

#include "evaluation/evaluated.hpp"

namespace language {
namespace {

TEST(Errors, AssertionsAreTraced) {
  const Evaluated result = evaluated(R"(function g(x) = assert(x < 5, "big") x;
function f(n) = n > 100 ? 1 : let (a = g(n)) f(n = g(n + 1));
q = function(x) [for (i = [0:1]) f(x)];
module m() { children(); }
cube(1);
translate([1, 2, 3]) for (i = [0]) if (true) m() { b = abs((true ? q : 1)(i)); cube(b); }
)");
  EXPECT_EQ(result.messages, R"(ERROR: Assertion '(x < 5)' failed: "big" in file design.scad, line 1
TRACE: called by 'g' in file design.scad, line 2
TRACE: called by 'f' in file design.scad, line 3
TRACE: called by '((true ? q : 1))' in file design.scad, line 6
TRACE: called by 'abs' in file design.scad, line 6
TRACE: called by 'm' in file design.scad, line 6
TRACE: called by 'if' in file design.scad, line 6
TRACE: called by 'for' in file design.scad, line 6
TRACE: called by 'translate' in file design.scad, line 6
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Errors, DefaultsAreTraced) {
  const Evaluated result = evaluated(R"(module m(x = assert(false) 1) { }
scale(2) m(3);
)");
  EXPECT_EQ(result.messages, R"(ERROR: Assertion 'false' failed in file design.scad, line 1
TRACE: called by 'm' in file design.scad, line 2
TRACE: called by 'scale' in file design.scad, line 2
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Errors, AssertionsWithoutCondition) {
  const Evaluated result = evaluated(R"(assert();
)");
  EXPECT_EQ(result.messages,
            R"(WARNING: Ignoring unknown variable 'condition' in file design.scad, line 1
ERROR: Assertion failed in file design.scad, line 1
TRACE: called by 'assert' in file design.scad, line 1
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Errors, TracesEnd) {
  const Evaluated result =
      evaluated(R"(module m(n) { translate([n, 0, 0]) m(n + 1); assert(n < 20); }
module r(n) { if (n < 20) r(n + 1); else assert(false); }
r(0);
)");
  EXPECT_EQ(result.messages, R"(ERROR: Assertion 'false' failed in file design.scad, line 2
TRACE: called by 'assert' in file design.scad, line 2
TRACE: called by 'if' in file design.scad, line 2
TRACE: called by 'r' in file design.scad, line 2
TRACE: called by 'if' in file design.scad, line 2
TRACE: called by 'r' in file design.scad, line 2
TRACE: called by 'if' in file design.scad, line 2
TRACE: called by 'r' in file design.scad, line 2
TRACE: called by 'if' in file design.scad, line 2
TRACE: called by 'r' in file design.scad, line 2
TRACE: called by 'if' in file design.scad, line 2
TRACE: called by 'r' in file design.scad, line 2
TRACE: called by 'if' in file design.scad, line 2
)");
  EXPECT_EQ(result.tree, R"(
)");
}

// Returns the error that ends a program.
std::string error_of(const std::string& program) {
  const Evaluated result = evaluated(program);
  EXPECT_EQ(result.evaluation.outcome, Outcome::kAborted) << program;
  const size_t at = result.messages.find("ERROR: ");
  if (at == std::string::npos) return "";
  return result.messages.substr(at, result.messages.find('\n', at) - at);
}

// OpenSCAD ends in these without a word, where its stack or the memory does.
TEST(Errors, EndlessTextsEnd) {
  const std::string nested = std::string(144, '[') + "a" + std::string(144, ']');
  EXPECT_EQ(error_of("module rec(a = 1) {\n  echo(a);\n  rec(" + nested + ");\n}\nrec();"),
            "ERROR: Stack exhausted while trying to convert a vector to EchoString in file "
            "design.scad, line 2");
  EXPECT_EQ(error_of("function f(a, n) = f(" + nested + ", len(str(a)));\necho(f(1));"),
            "ERROR: Stack exhausted while trying to convert a vector to EchoString in file "
            "design.scad, line 1");
  EXPECT_EQ(error_of("function f(n) = n == 0 ? 1 : let (a = f(n - 1)) [a, a];\necho(f(60));"),
            "ERROR: A text takes too much memory: more than 32 MiB in file design.scad, line 2");
  EXPECT_EQ(error_of("function f(n) = n == 0 ? \"0123456789abcdef\" : str(f(n - 1), f(n - 1));\n"
                     "s = f(20);\nfor (i = [0:9])\n  echo(s);"),
            "ERROR: The design's messages take too much memory: more than 64 MiB in file "
            "design.scad, line 4");
}

TEST(Errors, EndlessValuesEnd) {
  EXPECT_EQ(error_of("function f(v) = f(concat(v, [v]));\necho(f([1]));"),
            "ERROR: Recursion detected calling function 'f' in file design.scad, line 1");
  EXPECT_EQ(error_of("function f(v) = 1 +\nf(concat(v, [v]));\necho(f([1]));"),
            "ERROR: Recursion detected calling function 'f' in file design.scad, line 2");
  EXPECT_EQ(error_of("function f(a) = f(" + std::string(144, '[') + "a" + std::string(144, ']') +
                     " * 1);\necho(f(1));"),
            "ERROR: Vectors nest too deeply: more than 30000 in one another in file design.scad, "
            "line 1");
  EXPECT_EQ(error_of("function f(v) = let (w = v * 2) 1 + f([w, w]);\necho(f([1]));"),
            "ERROR: The design's values take too much memory in file design.scad, line 1");
}

// A design may take more than a recursion that has no end: what counts is what the inner calls
// make.
TEST(Errors, LargeValuesAndDeepCallsDoNotMakeARecursionEndless) {
  EXPECT_EQ(
      evaluated("large = [for (i = [0:899999]) [i, i, i, i, i, i, i, i]];\n"
                "function f(n) = n == 0 ? len(large) : 0 + f(n - 1);\n"
                "function g(n, list = []) = n == 0 ? len(list) : g(n - 1, concat([n], [n]));\n"
                "echo(f(20000), g(20000));")
          .messages,
      "ECHO: 900000, 2\n");
}

TEST(Errors, HardWarningsEnd) {
  const Evaluated result = evaluated(R"(function f(x) = x + zz;
module m(x = 1) { cube(size = f(x)); }
m(3);
echo("no");
)",
                                     {.hard_warnings = true});
  EXPECT_EQ(result.messages, R"(WARNING: Ignoring unknown variable 'zz' in file design.scad, line 1
TRACE: called by 'f' in file design.scad, line 2
TRACE: called by 'cube' in file design.scad, line 2
TRACE: called by 'm' in file design.scad, line 3
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Errors, UncheckedParameters) {
  const Evaluated result = evaluated(R"(module m(a) { echo(a); }
m(1, 2, z = 3);
function f(a) = a;
echo(f(1, 2));
)",
                                     {.check_parameters = false});
  EXPECT_EQ(result.messages, R"(ECHO: 1
WARNING: Too many unnamed arguments supplied in file design.scad, line 4
ECHO: 1
)");
  EXPECT_EQ(result.tree, R"(group();

)");
}

TEST(Errors, UsedFilesAreEvaluatedAnew) {
  const Evaluated result = evaluated(R"(use <library.scad>
$z = 1;
echo(lf(b = echo("argument") 2));
lm(a = 2) { $lv = 9; q = echo("block") 1; echo($lv, q); }
h = gf();
echo(h(), gf() == gf(), libv);
)");
  EXPECT_EQ(result.messages, R"(ECHO: "library"
ECHO: "library"
ECHO: "default"
ECHO: "argument"
ECHO: [1, 2, 3, 7, 1]
ECHO: "library"
ECHO: "block"
ECHO: "body", 2, 7, 1
ECHO: 7, 1
ECHO: "library"
ECHO: "library"
WARNING: Ignoring unknown variable 'libv' in file design.scad, line 6
ECHO: 3, false, undef
)");
  EXPECT_EQ(result.tree, R"(group() {
	group();
}

)");
}

TEST(Errors, UsedFilesThatSayNothing) {
  const Evaluated result = evaluated(R"(use <quiet.scad>
$q = 1;
echo(value(), [for ($q = [2, 3]) value()], constant());
quiet($q = 4);
)");
  EXPECT_EQ(result.messages, R"(ECHO: 10, [20, 30], [0, 1, 2, 3]
ECHO: 10, 4
)");
  EXPECT_EQ(result.tree, R"(group();

)");
}

TEST(Errors, NameFilesRelativeToTheUnitOrTheMainFile) {
  EXPECT_EQ(evaluated("use <folder/unset.scad>\necho(unset());").messages,
            R"(WARNING: Ignoring unknown variable '$name' in file unset.scad, line 1
WARNING: Ignoring unknown variable '$children' in file folder/unset.scad, line 1
WARNING: Ignoring unknown variable 'name' in file folder/unset.scad, line 1
ECHO: [undef, undef, undef]
)");
}

}  // namespace
}  // namespace language
