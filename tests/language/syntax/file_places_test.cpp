// Where files are found, how messages name them, and what ends with them: each case is as OpenSCAD
// 2021.01 answers it.
#include "parsed_design.hpp"
#include "temporary_folder.hpp"

namespace language {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOverwriting = "x=1;\nx=2;\n";

/// The warning about kOverwriting in a file that is not the main one.
std::string overwritten(const std::string& path) {
  return "WARNING: x was assigned on line 1 of \"" + path + "\" but was overwritten in file " +
         path + ", line 2";
}

TEST(Use, IsTriedAgainFromTheFileThatIsParsed) {
  const DesignFolder folder;
  folder.write("main.scad", "include <sub/a.scad>");
  folder.write("sub/a.scad", "use <lib.scad>\nuse <none.scad>");
  folder.write("lib.scad", kOverwriting);
  const ParsedDesign design;
  EXPECT_EQ(design.lines,
            (Lines{"WARNING: Can't open library 'lib.scad'.",
                   "WARNING: Can't open library 'none.scad'.", overwritten("lib.scad")}));
  EXPECT_EQ(design.program.units[0].uses, std::vector<uint32_t>{1});
}

TEST(Use, OfAFileWithASyntaxErrorUsesNothing) {
  const DesignFolder folder;
  folder.write("main.scad", "use <a.scad>");
  folder.write("a.scad", "use <b.scad>\n)");
  folder.write("b.scad", kOverwriting);
  EXPECT_EQ(ParsedDesign().lines,
            Lines{"ERROR: Parser error: syntax error in file a.scad, line 2"});
}

TEST(Use, MeansTheLastPathIfItHasNone) {
  const DesignFolder folder;
  folder.write("main.scad", "use <none.scad>\nuse <>\ninclude <a.scad>\nuse <>\nuse <b.scad>");
  folder.write("a.scad", "");
  folder.write("b.scad", "use <>\nuse <no.scad>\nuse <>");
  EXPECT_EQ(
      ParsedDesign().lines,
      (Lines{"WARNING: Can't open library 'none.scad'.", "WARNING: Can't open library 'none.scad'.",
             "WARNING: Can't open library ''.",  // an include that succeeds has cleared it
             "WARNING: Can't open library 'no.scad'.", "WARNING: Can't open library 'no.scad'."}));
}

TEST(Use, SeesTheFileThatUsesAsTheMainOne) {
  const DesignFolder folder;
  folder.write("main.scad", "use <lib/a.scad>\nx=1;\nx=2;");
  folder.write("lib/a.scad", "use <deep/b.scad>\nuse <../main.scad>\ninclude <c.scad>\nx=2;");
  folder.write("lib/c.scad", "x=1;");
  folder.write("lib/deep/b.scad", kOverwriting);
  EXPECT_EQ(
      ParsedDesign().lines,
      (Lines{"WARNING: x was assigned on line 2 but was overwritten in file main.scad, line 3",
             "WARNING: x was assigned on line 2 of \"../main.scad\" but was overwritten in file "
             "../main.scad, line 3",
             overwritten("deep/b.scad")}));
}

TEST(MainFile, IsAnotherFileIfItsPathHasDots) {
  const DesignFolder folder;
  folder.write("main.scad", std::string(kOverwriting) + "include <main.scad>");
  const std::string told =
      "WARNING: x was assigned on line 1 but was overwritten in file main.scad, line 2";
  EXPECT_EQ(ParsedDesign("main.scad").lines[2], told);
  const ParsedDesign design("./main.scad");
  EXPECT_EQ(design.lines[0], told);
  EXPECT_EQ(design.lines[2], overwritten("main.scad"));
  EXPECT_EQ(design.program.files[0].canonical_path(), design.program.files[1].path);
}

TEST(Libraries, KeepTheirLinks) {
  const DesignFolder folder;
  folder.write("real/a.scad", std::string(kOverwriting) + "include <b.scad>");
  folder.write("real/b.scad", "y=1;");
  fs::create_directory_symlink("real", "linked");
  fs::create_symlink("a.scad", "real/link.scad");
  folder.write("main.scad", "include <a.scad>\ninclude <real/link.scad>");
  const frontend::Environment path("OPENSCADPATH", "./linked");
  const ParsedDesign design;
  ASSERT_EQ(design.program.files.size(), 4u);
  EXPECT_TRUE(design.program.files[1].path.ends_with("/./linked/a.scad"));
  EXPECT_TRUE(design.program.files[2].path.ends_with("/real/b.scad"));
  EXPECT_TRUE(design.program.files[3].path.ends_with("/real/a.scad"));
  // To messages both are one file, in which line 1 follows line 2.
  EXPECT_EQ(design.lines,
            (Lines{overwritten("real/a.scad"),
                   "WARNING: x was assigned on line 2 of \"real/a.scad\" but was overwritten in "
                   "file real/a.scad, line 1",
                   overwritten("real/a.scad")}));
}

TEST(Libraries, AreNamedRelativeToAPathWithDots) {
  const DesignFolder folder;
  folder.write("main.scad", "use <../b.scad>");
  folder.write("b.scad", "use <sub/c.scad>");
  folder.write("sub/c.scad", kOverwriting);
  const frontend::Environment path("OPENSCADPATH", "sub");
  EXPECT_EQ(ParsedDesign().lines, Lines{overwritten("sub/c.scad")});
}

TEST(Libraries, EndWhereTheFirstFolderHasTheFile) {
  const DesignFolder folder;
  folder.write("main.scad", "include <a.scad>");
  folder.write("first/a.scad", "include <a.scad>");
  folder.write("second/a.scad", "x=1;");
  const frontend::Environment path("OPENSCADPATH", "first:second");
  EXPECT_EQ(ParsedDesign().lines, Lines{"WARNING: Can't open include file 'a.scad'."});
}

TEST(Libraries, AreThoseOfTheStartFolderWhereTheUserHasNoFolder) {
  const DesignFolder folder;
  folder.write("sub/main.scad", "include <lib/a.scad>\ninclude <b.scad>");
  folder.write("lib/a.scad", "a=1;\ninclude <../c.scad>");
  folder.write("b.scad", "b=1;");
  folder.write("c.scad", "c=1;");
  folder.write("home/.local/share/none", "");
  const std::string missing = "WARNING: Can't open include file 'b.scad'.";
  for (const char* bare : {"", "bare"}) {
    const frontend::Environment home("HOME", bare);
    const ParsedDesign design("sub/main.scad");
    EXPECT_EQ(design.lines, Lines{missing});  // its name has no folder
    EXPECT_EQ(design.assignments(), (Lines{"a = 1", "c = 1"}));
  }
  const frontend::Environment home("HOME", fs::current_path() / "home");
  EXPECT_EQ(ParsedDesign("sub/main.scad").lines,
            (Lines{"WARNING: Can't open include file 'lib/a.scad'.", missing}));
}

TEST(Libraries, AreThoseOfTheStartFolderForAnEmptyPartOfThePath) {
  const DesignFolder folder;
  folder.write("sub/main.scad", "include <b.scad>");
  folder.write("b.scad", "b=1;");
  for (const char* parts : {"", ":", "/none:", ":/none", "/none::/nowhere"}) {
    const frontend::Environment path("OPENSCADPATH", parts);
    EXPECT_EQ(ParsedDesign("sub/main.scad").assignments(), Lines{"b = 1"}) << parts;
  }
}

TEST(Places, CountNoLineEndsBeforeAPath) {
  for (const char* start : {"use\r\n\n<none.scad>\n", "include\r\n\n<none.scad>\n"}) {
    EXPECT_EQ(parse_text(start + std::string("x=1;x=2;")).lines[1],
              "WARNING: x was assigned on line 2 but was overwritten in file <stdin>, line 2");
  }
}

TEST(Include, EndsInACommentThatGoesOn) {
  const DesignFolder folder;
  folder.write("main.scad", "include <a.scad> x = 1;\ny = 2;");
  folder.write("a.scad", "include <b.scad> u = 1;");
  folder.write("b.scad", "v = 3; // c");
  EXPECT_EQ(ParsedDesign().assignments(), (Lines{"v = 3", "y = 2"}));
}

TEST(Statements, AreParsedAgainWhereTheirWarningsDependOnTheMainFile) {
  const DesignFolder folder;
  folder.write("main.scad", "include <b.scad>\nuse <b.scad>");
  folder.write("a.scad", "include <b.scad>");  // which is the main one here, as it uses a.scad
  folder.write("b.scad", "use <a.scad>\nmodule m() { x = 1; x = 2; }");
  EXPECT_EQ(ParsedDesign().lines,
            Lines{"WARNING: x was assigned on line 2 but was overwritten in file b.scad, line 2"});
}

}  // namespace
}  // namespace language
