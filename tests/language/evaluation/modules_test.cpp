// Modules, children, loops (LANGUAGE.md, "Scopes and calls", "Builtin modules"). Expected texts are
// those of OpenSCAD 2021.01.
#include <gtest/gtest.h>

#include "evaluation/evaluated.hpp"

namespace language {
namespace {

TEST(Modules, EachCallIsAGroup) {
  const Evaluated result = evaluated(R"(module m() { cube(1); }
m();
module e() {}
e();
if (true) sphere(2);
if (0) cube(); else if (1) { a = 3; cube(a); }
for (i = [0:1], j = [i:2]) { k = i + j; cube([i, j, k]); }
let (a = 2) cube(a);
union() { q = 3; cube(q); }
for () cube();
)");
  EXPECT_EQ(result.messages, R"()");
  EXPECT_EQ(result.tree, R"(group() {
	cube(size = [1, 1, 1], center = false);
}
group();
group() {
	sphere($fn = 0, $fa = 12, $fs = 2, r = 2);
}
group() {
	group() {
		cube(size = [3, 3, 3], center = false);
	}
}
group() {
	cube(size = [0, 0, 0], center = false);
	cube(size = [0, 1, 1], center = false);
	cube(size = [0, 2, 2], center = false);
	cube(size = [1, 1, 2], center = false);
	cube(size = [1, 2, 3], center = false);
}
group() {
	cube(size = [2, 2, 2], center = false);
}
union() {
	cube(size = [3, 3, 3], center = false);
}
group();

)");
}

TEST(Modules, IntersectionForIsFlat) {
  const Evaluated result =
      evaluated(R"(intersection_for (i = [0:1], j = [1:2]) { cube(i); cube(j); }
)");
  EXPECT_EQ(result.messages, R"()");
  EXPECT_EQ(result.tree, R"(intersection() {
	cube(size = [0, 0, 0], center = false);
	cube(size = [1, 1, 1], center = false);
	cube(size = [0, 0, 0], center = false);
	cube(size = [2, 2, 2], center = false);
	cube(size = [1, 1, 1], center = false);
	cube(size = [1, 1, 1], center = false);
	cube(size = [1, 1, 1], center = false);
	cube(size = [2, 2, 2], center = false);
}

)");
}

TEST(Modules, ChildrenAreSelected) {
  const Evaluated result = evaluated(
      R"(module m() { children(0); children([1, 0]); children([0:5]); children(-1); children(7); children([7, "a"]); children("a"); children(undef); children(0.7); child(); child(9); #children(0); #children(); children([0:20000]); }
m() { cube(1); echo("z"); }
m();
)");
  EXPECT_EQ(result.messages, R"(ECHO: "z"
ECHO: "z"
WARNING: Children index (2) out of bounds (2 children)
WARNING: Children index (3) out of bounds (2 children)
WARNING: Children index (4) out of bounds (2 children)
WARNING: Children index (5) out of bounds (2 children)
WARNING: Negative children index (-1) not allowed
WARNING: Children index (7) out of bounds (2 children)
WARNING: Children index (7) out of bounds (2 children)
WARNING: Bad parameter type (a) for children, only accept: empty, number, vector, range.
WARNING: Bad parameter type ("a") for children, only accept: empty, number, vector, range in file design.scad, line 1
WARNING: Bad parameter type (undef) for children, only accept: empty, number, vector, range in file design.scad, line 1
DEPRECATED: child() will be removed in future releases. Use children() instead.
WARNING: Child index (9) out of bounds (2 children) in file design.scad, line 1
ECHO: "z"
WARNING: Bad range parameter for children: too many elements (20001) in file design.scad, line 1
WARNING: Children index (0) out of bounds (0 children)
WARNING: Children index (1) out of bounds (0 children)
WARNING: Children index (0) out of bounds (0 children)
WARNING: Children index (0) out of bounds (0 children)
WARNING: Children index (1) out of bounds (0 children)
WARNING: Children index (2) out of bounds (0 children)
WARNING: Children index (3) out of bounds (0 children)
WARNING: Children index (4) out of bounds (0 children)
WARNING: Children index (5) out of bounds (0 children)
WARNING: Negative children index (-1) not allowed
WARNING: Children index (7) out of bounds (0 children)
WARNING: Children index (7) out of bounds (0 children)
WARNING: Bad parameter type (a) for children, only accept: empty, number, vector, range.
WARNING: Bad parameter type ("a") for children, only accept: empty, number, vector, range in file design.scad, line 1
WARNING: Bad parameter type (undef) for children, only accept: empty, number, vector, range in file design.scad, line 1
WARNING: Children index (0) out of bounds (0 children)
WARNING: Child index (0) out of bounds (0 children) in file design.scad, line 1
WARNING: Child index (9) out of bounds (0 children) in file design.scad, line 1
WARNING: Children index (0) out of bounds (0 children)
WARNING: Bad range parameter for children: too many elements (20001) in file design.scad, line 1
)");
  EXPECT_EQ(result.tree, R"(group() {
	cube(size = [1, 1, 1], center = false);
	group() {
		cube(size = [1, 1, 1], center = false);
	}
	group() {
		cube(size = [1, 1, 1], center = false);
	}
	group();
	cube(size = [1, 1, 1], center = false);
	cube(size = [1, 1, 1], center = false);
	cube(size = [1, 1, 1], center = false);
#	group() {
		cube(size = [1, 1, 1], center = false);
	}
}
group() {
	group();
	group();
	group();
#	group();
}

)");
}

TEST(Modules, ChildrenBelongToTheModuleAround) {
  const Evaluated result = evaluated(R"(module m() { children(); }
module o() { m() { children(); cube(2); } }
o() sphere(1);
children();
child(-1);
)");
  EXPECT_EQ(result.messages,
            R"(DEPRECATED: child() will be removed in future releases. Use children() instead.
WARNING: Negative child index (-1) not allowed in file design.scad, line 5
)");
  EXPECT_EQ(result.tree, R"(group() {
	group() {
		group() {
			group() {
				sphere($fn = 0, $fa = 12, $fs = 2, r = 1);
			}
			cube(size = [2, 2, 2], center = false);
		}
	}
}

)");
}

TEST(Modules, BlocksAreAssignedBeforeTheCall) {
  const Evaluated result =
      evaluated(R"(module m(a = echo("default") 1) { echo("body"); children(); }
m(echo("argument") 2) { q = echo("block") 1; cube(q); }
translate(echo("v") "a") { z = echo("assign") 1; cube(z); }
cube("a") sphere();
)");
  EXPECT_EQ(result.messages, R"(ECHO: "block"
ECHO: "default"
ECHO: "argument"
ECHO: "body"
ECHO: "v"
ECHO: "assign"
WARNING: Unable to convert translate("a") parameter to a vec3 or vec2 of numbers in file design.scad, line 3
WARNING: module cube() does not support child modules in file design.scad, line 4
WARNING: Unable to convert cube(size="a", ...) parameter to a number or a vec3 of numbers in file design.scad, line 4
)");
  EXPECT_EQ(result.tree, R"(group() {
	group() {
		cube(size = [1, 1, 1], center = false);
	}
}
multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {
	cube(size = [1, 1, 1], center = false);
}
cube(size = [1, 1, 1], center = false);

)");
}

TEST(Modules, EchoAndAssertAreGroupsOfChildren) {
  const Evaluated result = evaluated(R"(echo(1, a = 2, "s", $b = [3]) cube(1);
echo();
assert(true, "x") { }
assert(true) cube(2);
linear_extrude(echo("again") 5) square(1);
)");
  EXPECT_EQ(result.messages, R"(ECHO: 1, a = 2, "s", $b = [3]
ECHO: 
ECHO: "again"
ECHO: "again"
)");
  EXPECT_EQ(result.tree, R"(group() {
	cube(size = [1, 1, 1], center = false);
}
group() {
	cube(size = [2, 2, 2], center = false);
}
linear_extrude(height = 5, center = false, convexity = 1, scale = [1, 1], $fn = 0, $fa = 12, $fs = 2) {
	square(size = [1, 1], center = false);
}

)");
}

TEST(Modules, ParentModules) {
  const Evaluated result =
      evaluated(R"(module p() { echo(parent_module(0), parent_module(1), $parent_modules); }
module q() { p(); }
q();
)");
  EXPECT_EQ(result.messages, R"(ECHO: "p", "q", 2
)");
  EXPECT_EQ(result.tree, R"(group() {
	group();
}

)");
}

TEST(Modules, CountAmongParentModulesFromTheirDefaultsOn) {
  const Evaluated result = evaluated(R"(
module m(x, y = [$parent_modules, parent_module(0)]) { echo(x, y, $parent_modules); children(); }
module p() m([$parent_modules, parent_module(1)]) { z = [$parent_modules, parent_module(0)]; echo(z); }
p();
m($parent_modules = 7);
m();
)");
  EXPECT_EQ(result.messages, R"(ECHO: [2, "p"], [2, "m"], 2
ECHO: [1, "p"]
ECHO: undef, [1, "m"], 7
ECHO: undef, [1, "m"], 1
)");
}

TEST(Modules, UndeclaredArgumentsLeaveTheDefaultsOfOtherCalls) {
  const Evaluated result = evaluated(R"(
function ten(n) = n * 10;
module m(x = ten(2), y = ten(3)) echo(x, y);
module later() m(z = 1);
m(); later(); m(z = 2);
function f(x = ten(2), y) = [x, y, is_undef(z) ? 0 : z];
function later() = f(z = 1, w = 2);
echo(f(), later(), f(z = 4));
)");
  EXPECT_EQ(result.messages, R"(ECHO: 20, 30
WARNING: variable z not specified as parameter in file design.scad, line 4
ECHO: 20, 30
WARNING: variable z not specified as parameter in file design.scad, line 5
ECHO: 20, 30
WARNING: variable z not specified as parameter in file design.scad, line 7
WARNING: variable w not specified as parameter in file design.scad, line 7
WARNING: variable z not specified as parameter in file design.scad, line 8
ECHO: [20, undef, 0], [20, undef, 1], [20, undef, 4]
)");
}

TEST(Modules, RootModifiersOfTwoStatements) {
  const Evaluated result = evaluated(R"(!cube(1);
!sphere(2);
%cube(3);
)");
  EXPECT_EQ(result.messages, R"(WARNING: More than one Root Modifier (!) in file design.scad, line 2
)");
  EXPECT_EQ(result.tree, R"(cube(size = [1, 1, 1], center = false);

)");
}

}  // namespace
}  // namespace language
