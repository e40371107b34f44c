// Where statements begin and end.
#include "statements.hpp"

#include <gtest/gtest.h>

namespace serve {
namespace {

/// Returns the statement around the `|` of a text; "": none.
std::string around(std::string text) {
  const std::size_t at = text.find('|');
  text.erase(at, 1);
  const auto span = Statements(text).around(at);
  return span ? text.substr(span->begin, span->end - span->begin) : "";
}

TEST(Statements, EndAtSemicolonsAndBraces) {
  EXPECT_EQ(around("cu|be(1); sphere(2);"), "cube(1);");
  EXPECT_EQ(around("cube(1); sphere(2|);"), "sphere(2);");
  EXPECT_EQ(around("cube(1);|"), "cube(1);");
  EXPECT_EQ(around("translate([1, 2, 3]) cu|be(1);"), "translate([1, 2, 3]) cube(1);");
  EXPECT_EQ(around("x = [for (i = [1; 2]) i|]; cube();"), "x = [for (i = [1; 2]) i];");
  EXPECT_EQ(around("cube(1);\n\n|\n"), "");
  EXPECT_EQ(around("include <a.scad>\ncu|be(1);"), "cube(1);");
  EXPECT_EQ(around("include <a.s|cad>\ncube(1);"), "");
}

TEST(Statements, TheInnermostCounts) {
  const std::string design = "difference() { cube(9); module m() { sphere(1); } cylinder(2); }";
  EXPECT_EQ(around("diff|erence() { cube(9); }"), "difference() { cube(9); }");
  EXPECT_EQ(around("difference() { cu|be(9); }"), "cube(9);");
  EXPECT_EQ(around("difference() { cube(9); } |"), "");
  EXPECT_EQ(around("module m() { a(); b|(); } c();"), "b();");
  EXPECT_EQ(around("module m|() { a(); b(); } c();"), "module m() { a(); b(); }");
  EXPECT_EQ(around("{ a(); { b(|); } }"), "b();");
}

TEST(Statements, AnElseBelongsToItsIf) {
  EXPECT_EQ(around("if (a) b(); else c|(); d();"), "if (a) b(); else c();");
  EXPECT_EQ(around("if (a) { b(); } else { c(); |} d();"), "if (a) { b(); } else { c(); }");
  EXPECT_EQ(around("if (a) { b(); } else { c|(); } d();"), "c();");
  EXPECT_EQ(around("if (a) b(); else c(); d|();"), "d();");
}

TEST(Statements, AreFoundInBrokenTexts) {
  EXPECT_EQ(around("} cube|(1);"), "cube(1);");
  EXPECT_EQ(around("{ cube|(1) } sphere(2);"), "cube(1) ");
  EXPECT_EQ(around("cube([1, 2; } sph|ere(2);"), "cube([1, 2; } sphere(2);");
  EXPECT_EQ(around("union() { cube(1|"), "cube(1");
  EXPECT_EQ(around("|"), "");
}

TEST(Statements, BeginAtTheirCalls) {
  const std::string text = "translate([1, 0, 0]) cube(1); sphere(2);";
  const Span span = Statements(text).from(static_cast<uint32_t>(text.find("cube")));
  EXPECT_EQ(text.substr(span.begin, span.end - span.begin), "cube(1);");
}

}  // namespace
}  // namespace serve
