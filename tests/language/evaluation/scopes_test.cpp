// Scopes, names and arguments (LANGUAGE.md, "Scopes and calls"). Expected texts are those of
// OpenSCAD 2021.01.
#include <gtest/gtest.h>

#include "evaluation/evaluated.hpp"

namespace language {
namespace {

TEST(Scopes, ParametersHideOuterNames) {
  const Evaluated result = evaluated(R"(a = 1;
function f(a) = a;
echo(f());
)");
  EXPECT_EQ(result.messages, R"(ECHO: undef
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Scopes, UnsetNamesAreLookedForFurtherOut) {
  const Evaluated result = evaluated(R"(y = 1;
module m() { x = y; y = 2; echo(x, y); }
m();
function f() = z;
a = f();
z = 3;
echo(a, f());
)");
  EXPECT_EQ(result.messages, R"(WARNING: Ignoring unknown variable 'z' in file design.scad, line 4
ECHO: 1, 2
ECHO: undef, 3
)");
  EXPECT_EQ(result.tree, R"(group();

)");
}

TEST(Scopes, AnAssignmentSeesItsOldValue) {
  const Evaluated result = evaluated(R"(x = 1;
module m(p) { p = p + 1; x = x + 1; echo(p, x); if (true) { x = x + 1; echo(x); } }
m(4);
)");
  EXPECT_EQ(result.messages, R"(ECHO: 5, 2
ECHO: 3
)");
  EXPECT_EQ(result.tree, R"(group() {
	group();
}

)");
}

TEST(Scopes, LiteralsOverParametersWarn) {
  const Evaluated result = evaluated(R"(module m(a, b) { a = 3; b = -[1, "x"]; c = 4; echo(a, c); }
m(1, c = 2);
)");
  EXPECT_EQ(result.messages,
            R"(WARNING: variable c not specified as parameter in file design.scad, line 2
WARNING: Module m: Parameter a is overwritten with a literal in file design.scad, line 1
WARNING: Module m: Parameter b is overwritten with a literal in file design.scad, line 1
WARNING: Module m: Parameter c is overwritten with a literal in file design.scad, line 1
ECHO: 3, 4
)");
  EXPECT_EQ(result.tree, R"(group();

)");
}

TEST(Scopes, DynamicNamesAreSeenByCallees) {
  const Evaluated result = evaluated(R"(module n($y = 9) { echo($y); children(); }
module m() { $y = 1; n() echo("inner", $y); children(); }
m() { $y = 2; echo("block", $y); }
translate($y = 5) { $y = 6; z = $y; echo($y, z); }
echo($y);
)");
  EXPECT_EQ(result.messages, R"(ECHO: 9
ECHO: "inner", 9
ECHO: "block", 1
WARNING: Unable to convert translate(undef) parameter to a vec3 or vec2 of numbers in file design.scad, line 4
ECHO: 5, 5
WARNING: Ignoring unknown variable '$y' in file design.scad, line 5
ECHO: undef
)");
  EXPECT_EQ(result.tree, R"(group() {
	group() {
		group();
	}
	group();
}
multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]);

)");
}

TEST(Scopes, UsedFilesAreEvaluatedAgainWhereThatCanBeTold) {
  EXPECT_EQ(evaluated(R"(use <changing.scad>
module a() echo(name());
module b() { echo(name(), number() == number()); }
a();
b();
)")
                .messages,
            "ECHO: \"a\"\nECHO: \"b\", false\n");
}

TEST(Scopes, ChildCountIsLexical) {
  const Evaluated result = evaluated(R"(function c() = $children;
module m() { echo($children, $parent_modules, c()); children(); }
m() { cube(1); m() { echo($children); } *cube(2); }
)");
  EXPECT_EQ(result.messages,
            R"(WARNING: Ignoring unknown variable '$children' in file design.scad, line 1
ECHO: 2, 1, undef
WARNING: Ignoring unknown variable '$children' in file design.scad, line 1
ECHO: 1, 2, undef
WARNING: Ignoring unknown variable '$children' in file design.scad, line 3
ECHO: undef
)");
  EXPECT_EQ(result.tree, R"(group() {
	group() {
		cube(size = [1, 1, 1], center = false);
		group() {
			group();
		}
	}
}

)");
}

TEST(Scopes, ArgumentsWarnInOrder) {
  const Evaluated result = evaluated(R"(function f(a, b) = [a, b, z];
z = 9;
echo(f(z = 1, z = 2, a = 3, a = 4, 5, 6, 7, 8), f());
)");
  EXPECT_EQ(result.messages,
            R"(WARNING: variable z not specified as parameter in file design.scad, line 3
WARNING: variable z not specified as parameter in file design.scad, line 3
WARNING: argument z supplied more than once in file design.scad, line 3
WARNING: argument a supplied more than once in file design.scad, line 3
WARNING: Too many unnamed arguments supplied in file design.scad, line 3
ECHO: [5, 6, 2], [undef, undef, 9]
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Scopes, DefaultsComeFirst) {
  const Evaluated result = evaluated(R"($y = 1;
function f(z, $y = echo("default") 9, w = echo("w", $y) 1) = [$y, z, w];
echo(f($y = 5, z = echo("z", $y) $y));
echo(f(z = echo("z", $y) $y, $y = 5));
)");
  EXPECT_EQ(result.messages, R"(ECHO: "default"
ECHO: "w", 9
ECHO: "z", 9
ECHO: [5, 9, 1]
ECHO: "default"
ECHO: "w", 9
ECHO: "z", 5
ECHO: [5, 5, 1]
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Scopes, ArgumentsAreEvaluatedInTheOrderOfAHashTable) {
  const Evaluated result = evaluated(R"(function e(x) = echo(x) x;
function f(zz, aa, bb, ab, ba, a1, b1) = 0;
x = f(e(1), e(2), e(3), e(4), e(5), e(6), e(7));
cube(e(1), e(true));
)");
  EXPECT_EQ(result.messages, R"(ECHO: 7
ECHO: 6
ECHO: 5
ECHO: 3
ECHO: 4
ECHO: 2
ECHO: 1
ECHO: true
ECHO: 1
)");
  EXPECT_EQ(result.tree, R"(cube(size = [1, 1, 1], center = true);

)");
}

TEST(Scopes, RightOperandsAreEvaluatedFirst) {
  const Evaluated result = evaluated(R"(function e(x) = echo(x) x;
x = e(1) + e(2) * e(3);
y = [7][e(0)] && e(1) < e(2);
z = [e(1):e(2):e(3)];
)");
  EXPECT_EQ(result.messages, R"(ECHO: 3
ECHO: 2
ECHO: 1
ECHO: 0
ECHO: 2
ECHO: 1
ECHO: 1
ECHO: 3
ECHO: 2
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Scopes, ModulesInModulesSeeTheirScopes) {
  const Evaluated result = evaluated(
      R"(module a(x) { module b(y) { function q() = y; echo(x, y, z, q()); children(); } z = 3; b(x + 1) children(); }
a(1) cube(1);
)");
  EXPECT_EQ(result.messages, R"(ECHO: 1, 2, 3, 2
)");
  EXPECT_EQ(result.tree, R"(group() {
	group() {
		group() {
			group() {
				cube(size = [1, 1, 1], center = false);
			}
		}
	}
}

)");
}

TEST(Scopes, UnknownNamesWarn) {
  const Evaluated result = evaluated(R"(echo(nosuch, $nosuch, nosuch(1));
nosuch(echo("no")) cube();
abs(1, 2);
x = norm();
norm = 3;
echo(norm([3, 4]), norm(), (norm)(1), [1](2), $fn(3));
)");
  EXPECT_EQ(result.messages,
            R"(WARNING: norm() number of parameters does not match in file design.scad, line 4
WARNING: Ignoring unknown variable 'nosuch' in file design.scad, line 1
WARNING: Ignoring unknown variable '$nosuch' in file design.scad, line 1
WARNING: Ignoring unknown function 'nosuch' in file design.scad, line 1
ECHO: undef, undef, undef
WARNING: Ignoring unknown module 'nosuch' in file design.scad, line 2
WARNING: Ignoring unknown module 'abs' in file design.scad, line 3
WARNING: norm() number of parameters does not match in file design.scad, line 6
WARNING: Can't call function on vector in file design.scad, line 6
WARNING: Ignoring unknown function '$fn' in file design.scad, line 6
ECHO: 5, undef, undef, undef, undef
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Scopes, IsUndefDoesNotWarn) {
  const Evaluated result = evaluated(R"(x = 1;
echo(is_undef(a), is_undef($a), is_undef(x), is_undef(undef), is_undef(a[0]), is_undef());
)");
  EXPECT_EQ(result.messages, R"(WARNING: Ignoring unknown variable 'a' in file design.scad, line 2
WARNING: is_undef() number of parameters does not match in file design.scad, line 2
ECHO: true, true, false, true, true, undef
)");
  EXPECT_EQ(result.tree, R"(
)");
}

}  // namespace
}  // namespace language
