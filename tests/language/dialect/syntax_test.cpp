// The syntax of 2026's dialect beside that of 2021.01. What 2026 says and makes was found by
// running OpenSCAD 2025.07.18.
#include "dialect/said.hpp"

namespace language {
namespace {

bool is_error(const std::string& messages) {
  return messages.find("Parser error") != std::string::npos;
}

TEST(Dialect, HasHexadecimalNumbers) {
  EXPECT_EQ(said_2026("echo(0x1F, 0xabcd, 0xFFFFFFFFFFFFFFFF);"), "ECHO: 31, 43981, 1.84467e+19\n");
  EXPECT_EQ(said_2021("0x1F = 3; echo(0x1F);"), "ECHO: 3\n");
  EXPECT_EQ(said_2026("echo(0x10000000000000000);"),
            "WARNING: Hexadecimal constant \"0x10000000000000000\" too large in file design.scad, "
            "line 1\nECHO: 1.84467e+19\n");
  EXPECT_EQ(said_2026("0xg = 1; echo(0xg);"),
            "DEPRECATED: Variable names starting with digits (\"0xg\") will be removed in future "
            "releases. in file design.scad, line 1\nECHO: 1\n");
}

TEST(Dialect, TellsImpreciseIntegers) {
  const std::string program = "echo(9007199254740993, 9007199254740994, 12345678901234567890.0);";
  EXPECT_EQ(said_2026(program),
            "WARNING: Integer \"9007199254740993\" cannot be represented precisely in file "
            "design.scad, line 1\nECHO: 9.0072e+15, 9.0072e+15, 1.23457e+19\n");
  EXPECT_EQ(said_2021(program), "ECHO: 9.0072e+15, 9.0072e+15, 1.23457e+19\n");
  EXPECT_EQ(said_2026("echo(0x20000000000001);"),
            "WARNING: Integer \"0x20000000000001\" cannot be represented precisely in file "
            "design.scad, line 1\nECHO: 9.0072e+15\n");
}

TEST(Dialect, TellsUndefinedEscapes) {
  EXPECT_EQ(said_2026("echo(\"\\q\\n\");"),
            "WARNING: Undefined escape sequence in file design.scad, line 1\nECHO: \"q\n\"\n");
  EXPECT_EQ(said_2021("echo(\"\\q\");"), "ECHO: \"q\"\n");
}

TEST(Dialect, CountsLinesWithinPaths) {
  const BesideFiles files = {{"quiet.scad", ""}};
  EXPECT_EQ(said_2026("use <\nquiet.scad>\ncube(1) sphere();", files),
            "WARNING: new lines 'use<>'-statement is not defined - behavior may change in the "
            "future in file design.scad, line 2\n"
            "WARNING: module cube() does not support child modules in file design.scad, line 3\n");
  EXPECT_EQ(said_2021("use <\nquiet.scad>\ncube(1) sphere();", files),
            "WARNING: module cube() does not support child modules in file design.scad, line 2\n");
}

TEST(Dialect, CountsReturnsWithinPaths) {
  const std::string program = "use <a\r\nnone.scad>\ncube(1) sphere();";
  const auto line_of_last = [](const std::string& said) { return said.substr(said.size() - 2); };
  EXPECT_EQ(line_of_last(said_2026(program)), "4\n");
  EXPECT_EQ(line_of_last(said_2021(program)), "2\n");
}

TEST(Dialect, CountsLinesOfPathsInParserErrors) {
  const BesideFiles files = {{"quiet.scad", ""}};
  const auto line_of_error = [&](const std::string& program) {
    const std::string said = said_2026(program, files);
    return said.substr(said.find("scad, line ", said.find("ERROR")) + 11, 1);
  };
  EXPECT_EQ(line_of_error("include\n<quiet.scad>\necho(1;"), "2");
  EXPECT_EQ(line_of_error("include <\nquiet.scad>\n\necho(1;"), "4");
}

TEST(Dialect, CountsLinesBeforePaths) {
  const auto lines = [](const std::string& first, const std::string& second) {
    const std::string end = " does not support child modules in file design.scad, line ";
    return "WARNING: Can't open library 'none.scad'. in file design.scad, line " + first +
           "\nWARNING: module cube()" + end + second + "\n";
  };
  EXPECT_EQ(said_2026("use\n\n<none.scad>\ncube(1) sphere();"), lines("1", "4"));
  EXPECT_EQ(said_2021("use\n\n<none.scad>\ncube(1) sphere();"),
            "WARNING: Can't open library 'none.scad'.\nWARNING: module cube() does not support "
            "child modules in file design.scad, line 2\n");
}

TEST(Dialect, HasNoDoubledCommas) {
  for (const char* const program :
       {"echo(1,,2);", "echo(,1);", "x=[1,,2];", "x=[,];", "x=[1,,];", "function f(a,,b)=1;",
        "function f(,a)=1;", "module m(a,,){}", "x=let(a=1,,b=2) a;"}) {
    EXPECT_TRUE(is_error(said_2026(program))) << program;
    EXPECT_FALSE(is_error(said_2021(program))) << program;
  }
  for (const char* const program : {"echo(1,);", "x=[1,];", "function f(a,)=1;", "module m(a,){}",
                                    "x=let(a=1,) a;", "x=[for(a=1,;a<2;a=a+1,) a];"}) {
    EXPECT_FALSE(is_error(said_2026(program))) << program;
    EXPECT_FALSE(is_error(said_2021(program))) << program;
  }
  for (const char* const program : {"echo(,);", "echo(1,,);"}) {
    EXPECT_TRUE(is_error(said_2026(program))) << program;
    EXPECT_TRUE(is_error(said_2021(program))) << program;
  }
}

TEST(Dialect, HasComprehensionsInParenthesesFirst) {
  EXPECT_EQ(said_2026("echo([(for (i = [1]) i)]);"), "ECHO: [1]\n");
  EXPECT_TRUE(is_error(said_2021("echo([(for (i = [1]) i)]);")));
}

TEST(Dialect, JoinsLoopsOverSeveralVariables) {
  const std::string program =
      "echo(function() [for (i = [1], j = i, 2) i]);echo(function() [for () 7]);"
      "echo([for () 7], [for (i = [1, 2], j = [i : 2]) 10 * i + j]);";
  EXPECT_EQ(said_2026(program),
            "ECHO: function() [for(i = [1], j = i, 2) (i)]\nECHO: function() [for() (7)]\n"
            "ECHO: [7], [11, 12, 22]\n");
  EXPECT_EQ(said_2021(program),
            "ECHO: function() [for(i = [1]) (for(j = i) (for(2) (i)))]\nECHO: function() [7]\n"
            "ECHO: [7], [11, 12, 22]\n");
}

TEST(Dialect, HasNegativeNumbers) {
  const std::string program = "echo(function() [-0, - 1, -(-2), -2 ^ 2, -a]);";
  EXPECT_EQ(said_2026(program), "ECHO: function() [0, -1, 2, -(2 ^ 2), -a]\n");
  EXPECT_EQ(said_2021(program), "ECHO: function() [-0, -1, --2, -(2 ^ 2), -a]\n");
}

TEST(Dialect, TakesADollarForAName) {
  EXPECT_EQ(said_2026("$ = 3; module m() echo($); m(); m($ = 4);"), "ECHO: 3\nECHO: 4\n");
  EXPECT_TRUE(is_error(said_2021("$ = 3;")));
}

TEST(Dialect, TellsTheFirstOfOverwrittenAssignments) {
  const auto line_told = [](const std::string& said) {
    return said.substr(said.rfind("on line ") + 8, 1);
  };
  const std::string program = "a = 1;\na = 2;\na = 3;";
  EXPECT_EQ(line_told(said_2026(program)), "1");
  EXPECT_EQ(line_told(said_2021(program)), "2");
}

TEST(Dialect, QuotesOverwrittenNames) {
  EXPECT_EQ(said_2026("a = 1;\na = 2;"),
            "WARNING: \"a\" was assigned on line 1 but was overwritten in file design.scad, line "
            "2\n");
}

TEST(Dialect, SaysAgainWhatKeptStatementsSay) {
  EvaluationCache cache;
  const BesideFiles files = {
      {"included.scad", "2a = 1;\nfunction f(x) = \"\\q\";\nb = 4;\nmodule 3m() {}\n"}};
  const auto said = [&](LanguageVersion language) {
    EvaluationOptions options = in_language(language);
    options.cache = &cache;
    return evaluated("include <included.scad>\necho(b);\n", options, files).messages;
  };
  const std::string first = said(LanguageVersion::k2026);
  EXPECT_NE(first.find("\"2a\""), std::string::npos) << first;
  EXPECT_NE(first.find("escape"), std::string::npos) << first;
  EXPECT_NE(first.find("\"3m\""), std::string::npos) << first;
  EXPECT_EQ(said(LanguageVersion::k2026), first);
  EXPECT_EQ(said(LanguageVersion::k2021), "ECHO: 4\n");
  EXPECT_EQ(said(LanguageVersion::k2026), first);
}

}  // namespace
}  // namespace language
