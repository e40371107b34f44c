// Calls, tail calls, function values, comprehensions (LANGUAGE.md, "Scopes and calls"). Expected
// texts are those of OpenSCAD 2021.01.
#include <gtest/gtest.h>

#include "evaluation/evaluated.hpp"

namespace language {
namespace {

TEST(Functions, TailCallsKeepDefaultsAndUndeclaredNames) {
  const Evaluated result = evaluated(R"(k = 5;
function f(n, acc = k, b = echo("b") n) = n == 0 ? [acc, b] : f(n - 1);
echo(f(3), f(0, 9), f(2, 9));
function h(n, a) = n == 0 ? [a, zz] : n == 1 ? h(n - 1) : h(n - 1, zz = 8);
echo(h(2));
function j(n) = n == 0 ? $u : n == 1 ? j(n - 1) : let($u = n) j(n - 1);
echo(j(3));
)");
  EXPECT_EQ(result.messages, R"(ECHO: "b"
WARNING: Ignoring unknown variable 'n' in file design.scad, line 2
ECHO: "b"
ECHO: "b"
WARNING: Ignoring unknown variable 'n' in file design.scad, line 2
ECHO: "b"
WARNING: Ignoring unknown variable 'n' in file design.scad, line 2
ECHO: [5, 3], [9, undef], [5, 3]
WARNING: variable zz not specified as parameter in file design.scad, line 4
ECHO: [undef, 8]
ECHO: 2
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Functions, ElementsOfVariablesAreTheirs) {
  const Evaluated result = evaluated(R"(function f(v, i) = [v.x, v.z, v[i], v.begin, v.w, v[i].y];
echo(f([1, 2], 1), f([[3, 4]], 0), f([5 : 6], 2), f("ab", 1), f(undef, 0), f([1, 2], "a"));
)");
  EXPECT_EQ(
      result.messages,
      R"(ECHO: [1, undef, 2, undef, undef, undef], [[3, 4], undef, [3, 4], undef, undef, 4], [undef, undef, 6, 5, undef, undef], [undef, undef, "b", undef, undef, undef], [undef, undef, undef, undef, undef, undef], [1, undef, undef, undef, undef, undef]
)");
}

TEST(Functions, VectorsThatGrowInPlaceLeaveOthersAlone) {
  const Evaluated result = evaluated(R"(
function f(v, n) = n == 0 ? v : f(concat(v, [len(v)]), n - 1);
start = [7];
echo(f(start, 3), start, f(start, 1));
function g(v, all, n) = n == 0 ? all : g(concat(v, [n]), concat(all, [v]), n - 1);
echo(g([], [], 3));
function h(v, w, n) = n == 0 ? [v, w] : h(concat(v, w), v, n - 1);
echo(h([1], [2], 3));
function k(v, n) = n == 0 ? v : k(concat(v, n > 1 ? [v] : []), n - 1);
echo(k([1], 3));
function l(n, v) = n == 0 ? v : let(old = v) l(n - 1, concat(old, [v[0]]));
echo(l(2, [5, 6]));
function m(v, n) = n == 0 ? v : m(n == 2 ? concat(v, n) : len(v), n - 1);
echo(m([], 2), m(v = [1], n = 1));
echo([for (v = [], i = 0; i < 4; v = concat(v, [i]), i = i + 1) v]);
echo([for (v = [0], w = []; len(v) < 4; w = concat(v, [9]), v = concat(v, [len(w)])) [v, w]]);
)");
  EXPECT_EQ(result.messages, R"(ECHO: [7, 1, 2, 3], [7], [7, 1]
ECHO: [[], [3], [3, 2]]
ECHO: [[1, 2, 1, 1, 2], [1, 2, 1]]
ECHO: [1, [1], [1, [1]]]
ECHO: [5, 6, 5, 5]
ECHO: 1, 1
ECHO: [[], [0], [0, 1], [0, 1, 2]]
ECHO: [[[0], []], [[0, 2], [0, 9]], [[0, 2, 3], [0, 2, 9]]]
)");
}

// Copies of such vectors would take minutes.
TEST(Functions, VectorsGrowInPlace) {
  EXPECT_EQ(evaluated("function f(v, n) = n == 0 ? len(v) : f(concat(v, [n]), n - 1);\n"
                      "function g(v, n) = n == 0 ? len(v) : g(concat(v, [len(v)]), n - 1);\n"
                      "echo(f([], 400000), g([], 400000));\n"
                      "echo(len([for (v = [], i = 0; i < 400000; v = concat(v, [i]), i = i + 1)\n"
                      "  if (i == 399999) each v]));\n")
                .messages,
            "ECHO: 400000, 400000\nECHO: 399999\n");
}

// OpenSCAD 2021.01 cannot parse these; the texts are those of OpenSCAD 2025.07.18.
TEST(Functions, OperatorsOfBits) {
  const Evaluated result = evaluated(R"(echo(12&5, 12|5, 2<<3, 16>>2, ~5);
echo(1|2&4, 1|2<<3, 1+1<<2, 4>3&1, 1&1==1, ~1+2, ~2^2, 2^~1, !~0, ~~5, -~5);
echo([for (i = [0:3]) 1<<i]);
echo(1<<64, ~true);
assert(1 & ~1);
)");
  EXPECT_EQ(result.messages, R"(ECHO: 4, 13, 16, 4, -6
ECHO: 1, 17, 8, true, true, 0, -5, 0.25, false, 5, 6
ECHO: [1, 2, 4, 8]
WARNING: shift too large in file design.scad, line 4
WARNING: undefined operation (~bool) in file design.scad, line 4
ECHO: undef, undef
ERROR: Assertion '(1 & ~1)' failed in file design.scad, line 5
TRACE: called by 'assert' in file design.scad, line 5
)");
}

TEST(Functions, OperatorsOfNumbers) {
  const Evaluated result = evaluated(R"(echo(1+2, 1-2, 2*3, 1/4, 2^-1, -7%3, 7%-3, -7.5%2, -(3));
nan = 0 / 0;
echo(1<2, 2<=2, 1>2, 2>=2, nan<=nan, nan>=nan, nan==nan, nan!=nan, 0==-0);
)");
  EXPECT_EQ(result.messages, R"(ECHO: 3, -1, 6, 0.25, 0.5, -1, 1, -1.5, -3
ECHO: true, true, false, true, false, false, false, true, true
)");
}

TEST(Functions, LoopsInAVectorAppendBehindWhatIsThere) {
  const Evaluated result = evaluated(R"(echo([0, for (i = [1 : 2]) i, for (i = "ab") let (j = i) j,
  for (i = [0 : 1], j = [0 : 2]) i * 3 + j, for (i = []) i, 7]);
)");
  EXPECT_EQ(result.messages, "ECHO: [0, 1, 2, \"a\", \"b\", 0, 1, 2, 3, 4, 5, 7]\n");
}

TEST(Functions, TailCallsNeedNoStack) {
  const Evaluated result = evaluated(R"(function f(n, a = 0) = n == 0 ? a : f(n - 1, a + n);
g = function(n) n == 0 ? "end" : g(n - 1);
h = g;
echo(f(300000), g(300000), h(3));
)");
  EXPECT_EQ(result.messages, R"(ECHO: 4.50002e+10, "end", "end"
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Functions, EndlessTailCallsEnd) {
  const Evaluated result = evaluated(R"(function f(n) = f(n + 1);
module m() { cube(f(1)); }
m();
)");
  EXPECT_EQ(result.messages,
            R"(ERROR: Recursion detected calling function 'f' in file design.scad, line 1
TRACE: called by 'f' in file design.scad, line 2
TRACE: called by 'cube' in file design.scad, line 2
TRACE: called by 'm' in file design.scad, line 3
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Functions, EndlessFunctionValuesEnd) {
  const Evaluated result = evaluated(R"(f = function(n) f(n + 1);
echo(f(1));
)");
  EXPECT_EQ(result.messages,
            R"(ERROR: Recursion detected calling function 'f' in file design.scad, line 2
TRACE: called by 'f' in file design.scad, line 2
TRACE: called by 'echo' in file design.scad, line 2
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Functions, FunctionValues) {
  const Evaluated result = evaluated(R"(f = function(a, b = 2, $c = 3) [a, b, $c];
echo(f(1), f(b = 1), f(1, zz = 4), f(1, $c = 9), f);
fact = function(n) n == 0 ? 1 : n * fact(n - 1);
echo(fact(10), (function(a, a) a)(1, 2));
function apply(f, x) = f(x);
echo(apply(function(x) x * 2, 4), apply(sin, 4));
)");
  EXPECT_EQ(result.messages,
            R"(WARNING: variable zz not specified as parameter in file design.scad, line 2
ECHO: [1, 2, 3], [undef, 1, 3], [1, 2, 3], [1, 2, 9], function(a, b = 2, $c = 3) [a, b, $c]
ECHO: 3.6288e+6, 2
WARNING: Ignoring unknown variable 'sin' in file design.scad, line 6
WARNING: Ignoring unknown function 'f' in file design.scad, line 5
ECHO: 8, undef
)");
  EXPECT_EQ(result.tree, R"(
)");
}

// A call in tail position may be one of the running function, to which its names are new.
TEST(Functions, FunctionValuesPassNamesInTailCalls) {
  const Evaluated result = evaluated(R"(function named(t) = t;
a = function(x) named(t = x);
b = function(x) let(t = x + 1) named(t = t);
c = function(x, y = 4) named(t = [x, y]);
d = function(x) x > 2 ? [x, t] : d(t = 7, x = x + 1);
echo(a(1), b(2), c(3), d(1));
)");
  EXPECT_EQ(result.messages,
            R"(WARNING: variable t not specified as parameter in file design.scad, line 5
ECHO: 1, 3, [3, 4], [3, 7]
)");
}

TEST(Functions, FunctionValuesShareTheirScope) {
  const Evaluated result = evaluated(R"(z = function() later;
later = 5;
echo(z());
a = [for (i = [0:2]) function() i];
echo(a[0](), a[2]());
b = [for (i = 0; i < 3; i = i + 1) function() i];
echo(b[0]());
c = [for (i = [0:2]) let (j = i) function() j];
echo(c[0](), c[2]());
function t(n, acc = []) = n == 0 ? acc : t(n - 1, [each acc, function() n]);
for (f = t(2)) echo(f());
function outer(a) = let (h = function(b) a + b) h;
echo(outer(3)(4));
)");
  EXPECT_EQ(result.messages, R"(ECHO: 5
ECHO: 2, 2
ECHO: 3
ECHO: 0, 2
ECHO: 0
ECHO: 0
ECHO: 7
)");
  EXPECT_EQ(result.tree, R"(group();

)");
}

/// OpenSCAD never ends there: a file in Latin-1 has such texts.
TEST(Functions, BytesThatAreCutOffAreNoCharacter) {
  const Evaluated result = evaluated("s = \"caf\xe9\"; echo([for (c = s) c], [each s], len(s));\n");
  EXPECT_EQ(result.messages, "ECHO: [\"c\", \"a\", \"f\"], [\"c\", \"a\", \"f\"], 3\n");
}

TEST(Functions, Comprehensions) {
  const Evaluated result =
      evaluated(R"(echo([for (i = [0:3]) if (i % 2 == 0) i else let (q = i * 10) each [q, q]]);
echo([each [1, 2], each "ab", each [0:2], each undef, each 3, each each [[1, 2], [3]], each for (i = [0:1]) [i, i]]);
echo([for (i = [0:2], j = [0:i]) [i, j]], [for ($i = [0:2]) $i * 2]);
echo([for (i = 0, j = i; i < 4; i = i + 1, j = i * 10) [i, j]]);
echo([for (i = 5) i, for (i = undef) i, for (c = "a\u00e9") c, for () 3]);
echo([for (i = 0; i < 2; i = i + 1, k = 5) [i, k]]);
)");
  EXPECT_EQ(result.messages, R"(ECHO: [0, 10, 10, 2, 30, 30]
ECHO: [1, 2, "a", "b", 0, 1, 2, 3, 1, 2, 3, 0, 0, 1, 1]
ECHO: [[0, 0], [1, 0], [1, 1], [2, 0], [2, 1], [2, 2]], [0, 2, 4]
ECHO: [[0, 0], [1, 10], [2, 20], [3, 30]]
ECHO: [5, "a", "é", 3]
WARNING: Ignoring unknown variable 'k' in file design.scad, line 6
ECHO: [[0, undef], [1, 5]]
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Functions, LimitsOfLoops) {
  const Evaluated result = evaluated(R"(echo([for (i = [0:1e7]) i]);
for (i = [0:20000]) echo(i);
x = [for (i = 0; true; i = i + 1) 0 * i];
)");
  EXPECT_EQ(result.messages, R"(ERROR: For loop counter exceeded limit in file design.scad, line 3
)");
  EXPECT_EQ(result.tree, R"(
)");
}

TEST(Functions, LetWarnsOfDuplicates) {
  const Evaluated result = evaluated(R"(x = let (a = 1, a = echo("a") 2, 5, c = a) [a, c];
echo(x);
let (a = 1, a = 2, 5) echo(a);
assign (a = 1, a = 2, unknown, b = x) echo(a, b);
)");
  EXPECT_EQ(result.messages, R"(ECHO: "a"
WARNING: Ignoring duplicate variable assignment a = 2 in file design.scad, line 1
WARNING: Assignment without variable name 5 in file design.scad, line 1
ECHO: [1, 1]
WARNING: Ignoring duplicate variable assignment a = 2 in file design.scad, line 3
WARNING: Assignment without variable name 5 in file design.scad, line 3
ECHO: 1
DEPRECATED: The assign() module will be removed in future releases. Use a regular assignment instead. in file design.scad, line 4
ECHO: 2, [1, 1]
)");
  EXPECT_EQ(result.tree, R"(group();
group();

)");
}

TEST(Functions, LazyBuiltins) {
  const Evaluated result = evaluated(R"(function e(x) = echo(x) x;
x = [lookup(e("k"), e([[1, 2]])), rands(e(1), e("a"), e(1)), search(e(1))];
)");
  EXPECT_EQ(result.messages, R"(ECHO: "k"
ECHO: "k"
WARNING: lookup("k", ...) first argument is not a number in file design.scad, line 2
ECHO: 1
ECHO: "a"
WARNING: search() number of parameters does not match in file design.scad, line 2
)");
  EXPECT_EQ(result.tree, R"(
)");
}

}  // namespace
}  // namespace language
