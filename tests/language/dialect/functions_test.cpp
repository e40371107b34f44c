// Values and builtin functions of 2026's dialect beside those of 2021.01. What 2026 says and makes
// was found by running OpenSCAD 2025.07.18.
#include "dialect/said.hpp"

namespace language {
namespace {

std::string warning(const std::string& text) {
  return "WARNING: " + text + " in file design.scad, line 1\n";
}

TEST(Functions, EvaluateAllArguments) {
  const std::string program =
      "e = function(x) echo(x) x; x = abs(e(1), e(2)); y = log(e(\"a\"), e(3));";
  EXPECT_EQ(said_2026(program),
            "ECHO: 1\nECHO: 2\n" +
                warning("abs() number of parameters does not match: expected 1, found 2") +
                "ECHO: \"a\"\nECHO: 3\n" +
                warning("log() parameter could not be converted: argument 0: expected number, "
                        "found string (\"a\")"));
  EXPECT_EQ(said_2021(program), warning("abs() number of parameters does not match") +
                                    "ECHO: \"a\"\n" +
                                    warning("log() parameter could not be converted"));
}

TEST(Functions, TellHowManyArguments) {
  const auto count = [](const std::string& call, const std::string& expected) {
    const std::string name = call.substr(0, call.find('('));
    EXPECT_EQ(said_2026("x = " + call + ";"),
              warning(name + "() number of parameters does not match: expected " + expected));
  };
  count("rands(0, 1)", "3 or 4, found 2");
  count("search(1)", "between 2 and 4, found 1");
  count("search(1, [], 1, 0, 5)", "between 2 and 4, found 5");
  count("min()", "at least 1, found 0");
  count("max([])", "at least 1 vector element, found 0");
  count("log(1, 2, 3)", "2, found 3");
  count("ord(1, 2)", "1, found 2");
  count("cross([1, 2])", "2, found 1");
  count("parent_module(1, 2)", "1, found 2");
  count("is_undef()", "1, found 0");
}

TEST(Functions, TellWhichArgument) {
  const auto type = [](const std::string& call, const std::string& text) {
    const std::string name = call.substr(0, call.find('('));
    EXPECT_EQ(said_2026("x = " + call + ";"),
              warning(name + "() parameter could not be converted: " + text));
  };
  type("pow(1, \"a\")", "argument 1: expected number, found string (\"a\")");
  type("len(undef)", "argument 0: expected string, found undefined (undef)");
  type("norm(1)", "argument 0: expected vector, found number (1)");
  type("cross([1, 2], 3)", "argument 1: expected vector, found number (3)");
  type("lookup(1, \"a\")", "argument 1: expected vector, found string (\"a\")");
  type("lookup(1 / 0, 2)", "argument 1: expected vector, found number (2)");
  type("ord(1)", "argument 0: expected string, found number (1)");
  type("min([1, \"a\"])", "vector element 1: expected number, found string (\"a\")");
  type("max(3, [1])", "argument 1: expected number, found vector ([1])");
  type("rands(0, 1, true)", "argument 2: expected number, found bool (true)");
  EXPECT_EQ(said_2021("x = norm(1); y = lookup(1, \"a\");"), "");
}

TEST(Functions, KnowTheProgramThatIsImitated) {
  EXPECT_EQ(said_2026("echo(version(), version_num() == 20250718);"),
            "ECHO: [2025, 7, 18], true\n");
  EXPECT_EQ(said_2021("echo(version());"), "ECHO: [2021, 1, 0]\n");
}

TEST(Functions, RandsChecksAllTypesFirst) {
  const std::string program = "x = rands(1 / 0, 1, 2, \"a\");";
  EXPECT_EQ(said_2026(program),
            warning("rands() parameter could not be converted: argument 3: expected number, found "
                    "string (\"a\")"));
  EXPECT_NE(said_2021(program), said_2026(program));
}

TEST(Functions, ConvertToTheNearestInteger) {
  const std::string program =
      "echo(chr(4294967296 + 65), tan(1e12), search(1, [1, 1, 1], 4294967297));\n";
  EXPECT_EQ(said_2026(program), "ECHO: \"\", -5.67131, [0, 1, 2]\n");
  EXPECT_EQ(said_2021(program), "ECHO: \"A\", -5.67125, [0]\n");
  EXPECT_EQ(said_2026("x = parent_module(1e10);"),
            warning("Parent module index (2147483647) greater than the number of modules on the "
                    "stack"));
}

TEST(Ranges, CountNoMoreThan32Bits) {
  const std::string program = "for (i = [0:1e10]) echo(i);";
  const auto too_many = [](const std::string& count) {
    return warning("Bad range parameter in for statement: too many elements (" + count + ")");
  };
  EXPECT_EQ(said_2026(program), too_many("4294967295"));
  EXPECT_EQ(said_2021(program), too_many("1410065408"));
}

TEST(Functions, SearchFindsLongTexts) {
  const std::string program = "echo(search(\"tx\", [[\"this is a long text indeed\"]]));";
  EXPECT_EQ(said_2026(program), "ECHO: [0]\n");
  EXPECT_EQ(said_2021(program), warning("search term not found: \"t\"") +
                                    warning("search term not found: \"x\"") + "ECHO: []\n");
}

TEST(Ranges, ReversedOnesAreEmpty) {
  EXPECT_EQ(said_2026("echo([5:1]); a = 0; for (i = [a:-1]) echo(i);"),
            warning("begin is greater than the end, but step is positive") + "ECHO: [5 : 1 : 1]\n");
  EXPECT_EQ(said_2021("for (i = [2:1]) echo(i);").substr(0, 11), "DEPRECATED:");
  EXPECT_EQ(said_2026("for (i = [0:20000]) if (i == 20000) echo(i);"), "ECHO: 20000\n");
}

TEST(Files, AreFoundBesideTheFileThatHasTheCall) {
  const BesideFiles files = {{"used.scad", "module m() import(\"a.stl\");"},
                             {"lib/included.scad", "import(\"a.stl\"); x = import(\"b.json\");"},
                             {"lib/a.stl", ""},
                             {"lib/b.json", "1"}};
  const std::string program = "include <lib/included.scad>\nuse <used.scad>\nm(); echo(x);\n";
  const auto file_of = [](const std::string& tree) { return tree.substr(0, tree.find(", ")); };
  EXPECT_EQ(file_of(tree_2026(program, files)), "import(file = \"lib/a.stl\"");
  EXPECT_EQ(file_of(tree_2021(program, files)), "import(file = \"a.stl\"");
  EXPECT_EQ(said_2026(program, files), "ECHO: 1\n");
}

TEST(Files, MissingOnesAreToldWithTheirPlace) {
  EXPECT_EQ(said_2026("include <none.scad>\nuse <none.scad>\n"),
            "WARNING: Can't find include file 'none.scad'. in file design.scad, line 1\n"
            "WARNING: Can't open library 'none.scad'. in file design.scad, line 2\n");
  EXPECT_EQ(said_2021("include <none.scad>\n"), "WARNING: Can't open include file 'none.scad'.\n");
}

}  // namespace
}  // namespace language
