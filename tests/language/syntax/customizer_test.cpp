// What designs offer to their users. Openscad's own reading of the same texts (-o x.ast) is the
// reference.
#include "language/customizer.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace language {
namespace {

using ParameterLines = std::vector<std::string>;

/// Returns a parameter as one line: what of it is not empty.
std::string line_of(const CustomizerParameter& parameter) {
  std::ostringstream line;
  if (!parameter.group.empty()) line << "[" << parameter.group << "] ";
  line << parameter.name << "=" << set_text(parameter.value);
  if (!parameter.description.empty()) line << " (" << parameter.description << ")";
  if (const auto& range = parameter.range) {
    line << " " << range->min << ".." << range->max;
    if (range->step) line << " by " << *range->step;
  }
  if (parameter.step) line << " step " << *parameter.step;
  if (parameter.longest) line << " longest " << *parameter.longest;
  for (const ParameterChoice& choice : parameter.choices) {
    line << " <" << set_text(choice.value) << ":" << choice.label << ">";
  }
  return line.str();
}

ParameterLines lines_of(std::string_view text) {
  ParameterLines lines;
  const auto parameters = customizer_parameters(text);
  if (!parameters) return {"a syntax error"};
  for (const CustomizerParameter& parameter : *parameters) lines.push_back(line_of(parameter));
  return lines;
}

/// Returns what a comment behind `x = …;` makes of the parameter.
std::string annotated(const std::string& value, const std::string& comment) {
  auto parameters = customizer_parameters("x = " + value + "; //" + comment + "\n");
  if (!parameters || parameters->size() != 1) return "no parameter";
  const size_t length = ("x=" + set_text(parameters->front().value)).size();
  const std::string line = line_of(parameters->front());
  return line.size() > length ? line.substr(length + 1) : "";
}

TEST(Customizer, OffersLiterals) {
  EXPECT_EQ(
      lines_of("a=true; b=-1.50; c=\"x\\\"y\"; d=[1,-2]; e=[1,2,3,4,5]; f=[\"s\\\"\", 1];"
               "g=[0:2]; h=[0:.5:2]; i=(5); j=- -4; k=+4;"),
      (ParameterLines{"a=true", "b=-1.5", "c=x\"y", "d=[1, -2]", "e=[1, 2, 3, 4, 5]",
                      R"(f=["s\"", 1])", "g=[0 : 2]", "h=[0 : 0.5 : 2]", "i=5", "j=4", "k=4"}));
  EXPECT_EQ(lines_of("a=1+1; b=a; c=undef; d=[a]; e=[]; f=[[1]]; g=str(1); h=[true]; i=[0:a];"),
            ParameterLines{});
  EXPECT_EQ(lines_of("a=1; cube(a;"), ParameterLines{"a syntax error"});
  EXPECT_EQ(lines_of(""), ParameterLines{});
}

TEST(Customizer, OffersWhatStandsBeforeTheFirstBrace) {
  EXPECT_EQ(lines_of("a=1;\nfunction f(x)=x;\nmodule m() cube();\nb=2;\nc=1; module n() {}\nd=3;"),
            (ParameterLines{"a=1", "b=2"}));
  EXPECT_EQ(lines_of("// {\na=\"{\"; /* { */\nb=1;\n"), (ParameterLines{"a={ ({)", "b=1"}));
  EXPECT_EQ(lines_of("include <no.scad>\nuse <no.scad>\na=1;"), ParameterLines{"a=1"});
}

TEST(Customizer, TheLastAssignmentCounts) {
  EXPECT_EQ(lines_of("// one\na=1; // [1:5]\nb=1;\n// two\na=2; // [1:6]\n"),
            (ParameterLines{"a=2 (two) 1..6", "b=1"}));
}

TEST(Customizer, TellsWhereTheAssignmentsAre) {
  const auto parameters = customizer_parameters("// ü\n  a = 1;\nb=2; c = 3;");
  ASSERT_TRUE(parameters && parameters->size() == 3);
  EXPECT_EQ((*parameters)[0].offset, 8u);
  EXPECT_EQ((*parameters)[1].offset, 15u);
  EXPECT_EQ((*parameters)[2].offset, 20u);
}

TEST(Customizer, DescriptionsStandInTheLineAbove) {
  EXPECT_EQ(lines_of("//\tone \na=1;\n// two\n\nb=1;\n // three\nc=1;\n/* four */\nd=1;\n"
                     "// x\n// five\r\n  e=1;\nf=1; // six\ng=1;\n"),
            (ParameterLines{"a=1 (one)", "b=1", "c=1", "d=1", "e=1 (five)", "f=1", "g=1"}));
  EXPECT_EQ(lines_of("a=\"\n// no comment\"; b=1;\n/*\n// none\n*/ c=1;\n"),
            (ParameterLines{"a=// no comment", "b=1", "c=1"}));
}

TEST(Customizer, GroupsLastUntilTheNext) {
  EXPECT_EQ(lines_of("a=1;\n/* [ Size ] */\nb=1;\nc=1; /* [Shape] */\nd=1;\n/*[Hidden]*/\ne=1;\n"),
            (ParameterLines{"a=1", "[Size] b=1", "[Size] c=1", "[Shape] d=1", "[Hidden] e=1"}));
  EXPECT_EQ(
      lines_of("/* [A] */ /* [B] */\na=1;\n/* two\n[lines] */\nb=1;\n/* plain */\nc=1;\n"
               "/* x [ C ] y [ D ] */\nd=1; /* [E] */ e=1;\n// [F]\nf=\"/* [G] */\";\ng=1;\n"),
      (ParameterLines{"[B] a=1", "[B] b=1", "c=1", "[C - D] d=1", "[C - D] e=1",
                      "[E] f=/* [G] */ ([F])", "[E] g=1"}));
}

TEST(Customizer, CommentsBelongToTheOnlyStatementOfALine) {
  EXPECT_EQ(lines_of("a=\"x;y\"; // [b]\nb=\"//\"; //[c]\nc=1 /* x */ ; /* y */ // [3]\n"),
            (ParameterLines{"a=x;y <b:b>", "b=// <c:c>", "c=1 0..3"}));
  EXPECT_EQ(lines_of("a=1; b=1; // [3]\nc=1; cube(); // [3]\nif (a) cube(); d=1; // [3]\n"
                     "e=\n1; // [3]\nf=1\n; // [3]\ng=1; \"\"; // [3]\n"),
            ParameterLines{"a syntax error"});
  EXPECT_EQ(lines_of("a=1; b=1; // [3]\nc=1; cube(); // [3]\nif (a) cube(); d=1; // [3]\n"
                     "e=\n1; // [3]\nf=1\n; // [3]\n"),
            (ParameterLines{"a=1", "b=1", "c=1", "d=1", "e=1", "f=1"}));
}

TEST(Customizer, NumbersHaveRanges) {
  EXPECT_EQ(annotated("5", "[10]"), "0..10");
  EXPECT_EQ(annotated("5", " [1:10] "), "1..10");
  EXPECT_EQ(annotated("5", "[ -5 : .1 : 1e1 ]\r"), "-5..10 by 0.1");
  EXPECT_EQ(annotated("[1,2]", "[0:.5:9]"), "0..9 by 0.5");
  EXPECT_EQ(annotated("5", ".5"), "step 0.5");
  EXPECT_EQ(annotated("[1,2]", "2"), "step 2");
  EXPECT_EQ(annotated("5", "[+1:0:5]"), "1..5") << "no step";
  for (const char* nothing :
       {"[5:1]",       "[5:5]",   "[1:2:3:4]", "[1:10", "[1:10];",  "[1:10] mm", "1:10",  "[1 10]",
        "[1:10] // x", "[5] [6]", "[1::2]",    "[]",    "[1,2,]",   "[,1]",      "[a,b]", "[[1],2]",
        "-5",          "0",       "5 mm",      "",      "// [1:5]", "[1:a:b]"}) {
    EXPECT_EQ(annotated("5", nothing), "") << nothing;
  }
  EXPECT_EQ(annotated("true", "[0:1]"), "");
  EXPECT_EQ(annotated("[1,2]", "[3,4]"), "") << "no choices";
}

TEST(Customizer, NumbersAndTextsHaveChoices) {
  EXPECT_EQ(annotated("5", "[0, 5 ,10]"), "<0:0> <5:5> <10:10>");
  EXPECT_EQ(annotated("5", "[1 : Small  size, 2:\"Big, (round)\", -3:(tiny), 4:100%]"),
            "<1:Small size> <2:Big, (round)> <-3:tiny> <4:100%>");
  EXPECT_EQ(annotated("5", "[1:2, 3:4]"), "<1:2> <3:4>");
  EXPECT_EQ(annotated("\"a\"", "[a, dark blue, \"x, y\", 3 d, é]"),
            "<a:a> <dark blue:dark blue> <x, y:x, y> <3 d:3 d> <é:é>");
  EXPECT_EQ(annotated("\"a\"", "[S:Small, M:34 Medium, \"\":none]"),
            "<S:Small> <M:34 Medium> <:none>");
  EXPECT_EQ(annotated("\"a\"", "[16:9, 4:3]"), "<16:9> <4:3>");
  EXPECT_EQ(annotated("\"a\"", "[a b:c d:e]"), "");
  EXPECT_EQ(annotated("\"a\"", "20"), "longest 20");
  EXPECT_EQ(annotated("\"a\"", "a word"), "");
}

TEST(Customizer, SetsGiveValuesOfTheDefaultsType) {
  const auto given = [](std::string_view text, const ParameterValue& fallback) {
    const auto value = value_of_text(text, fallback);
    return value ? set_text(*value) + "|" + std::to_string(value->index()) : "none";
  };
  EXPECT_EQ(given("false", true), "false|0");
  EXPECT_EQ(given("0", true), "false|0");
  EXPECT_EQ(given("no", true), "none");
  EXPECT_EQ(given(" 2.50 ", 1.0), "2.5|1");
  EXPECT_EQ(given("x", 1.0), "none");
  EXPECT_EQ(given(" x ", std::string()), " x |2");
  EXPECT_EQ(given("[1, 2]", std::vector<double>{1}), "[1, 2]|3");
  EXPECT_EQ(given("[1, a b, \"c\"]", LiteralText{}), R"([1, "a b", "c"]|4)");
  EXPECT_EQ(given("[1:2]", LiteralText{}), "none");
  EXPECT_EQ(given("[1:2]", LiteralText{ValueType::kRange, {}}), "[1 : 2]|4");
}

TEST(Customizer, NumbersAreWrittenExactly) {
  for (const double number : {0.1, 1e20, -1e-20, 1.0 / 3, 123456789.0}) {
    const auto again = value_of_text(set_text(number), 0.0);
    ASSERT_TRUE(again) << set_text(number);
    EXPECT_EQ(std::get<double>(*again), number);
  }
}

}  // namespace
}  // namespace language
