// include, use, -D and the warnings about files and assignments.
#include <sys/stat.h>

#include "parsed_design.hpp"
#include "temporary_folder.hpp"

namespace language {
namespace {

TEST(Include, StandsForTheText) {
  const DesignFolder folder;
  folder.write("main.scad", "x = include <lib/value.scad> + 1; include <lib/value.scad>;");
  folder.write("lib/value.scad", "include <other.scad>");
  folder.write("lib/other.scad", "(2)");
  const ParsedDesign design;
  EXPECT_EQ(design.lines[0], "ERROR: Parser error: syntax error in file lib/other.scad, line 1");
  folder.write("main.scad", "x = include <lib/value.scad> + 1;");
  EXPECT_EQ(ParsedDesign().assignments(), Lines{"x = (2 + 1)"});
}

TEST(Include, FindsNoFileThatIsBeingIncluded) {
  const DesignFolder folder;
  folder.write("main.scad", "include <a.scad>\nx=1;");
  folder.write("a.scad", "include <a.scad>\nuse <a.scad>\ny=1;");
  const ParsedDesign design;
  // From main.scad the second is found, and includes itself once.
  EXPECT_EQ(design.lines, (Lines{"WARNING: Can't open include file 'a.scad'.",
                                 "WARNING: Can't open library 'a.scad'.",
                                 "WARNING: Can't open include file 'a.scad'.",
                                 "WARNING: Can't open library 'a.scad'."}));
  EXPECT_EQ(design.assignments(), (Lines{"y = 1", "x = 1"}));
}

TEST(Include, TakesThePathApart) {
  const DesignFolder folder;
  folder.write("main.scad",
               "include <lib/q\nx.scad>\ninclude\n<no/y.scad>use <>\ninclude <>\ninclude <lib>");
  folder.write("lib/x.scad", "x=1;");
  const ParsedDesign design;
  EXPECT_EQ(design.lines,
            (Lines{"WARNING: Can't open include file 'no/y.scad'.",
                   "WARNING: Can't open library 'y.scad'.", "WARNING: Can't open include file ''.",
                   "WARNING: Can't open include file 'lib'."}));
  EXPECT_EQ(design.assignments(), Lines{"x = 1"});
}

// A pipe is waited for, and some devices never end.
TEST(Include, ReadsRegularFilesOnly) {
  const DesignFolder folder;
  ASSERT_EQ(mkfifo("pipe", 0600), 0);
  folder.write("main.scad",
               "include <pipe>\n\ninclude </dev/zero> use <pipe>\nuse </dev/zero>\ny=1;");
  const ParsedDesign design;
  EXPECT_EQ(design.lines,
            (Lines{"WARNING: Can't open include file 'pipe': it is no regular file in file "
                   "main.scad, line 1",
                   "WARNING: Can't open include file '/dev/zero': it is no regular file in file "
                   "main.scad, line 3",
                   "WARNING: Can't open library 'pipe': it is no regular file in file main.scad, "
                   "line 3",
                   "WARNING: Can't open library '/dev/zero': it is no regular file in file "
                   "main.scad, line 4"}));
  EXPECT_EQ(design.assignments(), Lines{"y = 1"});
}

TEST(Include, FollowsOpenScadPath) {
  const DesignFolder folder;
  folder.write("main.scad", "include <x.scad>");
  folder.write("second/x.scad", "x=2;");
  folder.write("third/x.scad", "x=3;");
  const frontend::Environment path("OPENSCADPATH", "first:second:third");
  const ParsedDesign design;
  EXPECT_EQ(design.assignments(), Lines{"x = 2"});
  ASSERT_EQ(design.program.lookups.size(), 2u);
  EXPECT_TRUE(design.program.lookups[1].ends_with("/first/x.scad"));
}

TEST(Include, EndsWhereItsFileEnds) {
  const DesignFolder folder;
  folder.write("main.scad", "x=1;\r\n\r\ninclude <open.scad>\r\n}");
  folder.write("open.scad", "\n\n\nmodule m()");
  EXPECT_EQ(ParsedDesign().lines[0], "ERROR: Parser error: syntax error in file main.scad, line 6");
}

TEST(Use, ParsesEachFileOnceInOpenScadsOrder) {
  const DesignFolder folder;
  folder.write("main.scad", "use <a.scad>\nuse <b.scad>\nuse <a.scad>\nz=1;z=2;");
  folder.write("a.scad", "use <d.scad>\nuse <c.scad>\nx=1;\nx=2;");
  for (const std::string name : {"b", "c", "d"}) folder.write(name + ".scad", "x=1;\n\nx=3;");
  const ParsedDesign design;
  const auto overwritten = [](const std::string& name) {
    return "WARNING: x was assigned on line 1 of \"" + name + "\" but was overwritten in file " +
           name + ", line 3";
  };
  EXPECT_EQ(
      design.lines,
      (Lines{"WARNING: z was assigned on line 4 but was overwritten in file main.scad, line 4",
             "WARNING: x was assigned on line 3 of \"a.scad\" but was overwritten in file "
             "a.scad, line 4",
             overwritten("c.scad"), overwritten("d.scad"), overwritten("b.scad")}));
  EXPECT_EQ(design.program.units.size(), 5u);
  EXPECT_EQ(design.program.units[0].uses, (std::vector<uint32_t>{2, 1}));
}

TEST(Use, SurvivesSyntaxErrorsAndCircles) {
  const DesignFolder folder;
  folder.write("main.scad", "use <a.scad>\nuse <main.scad>\nuse <bad.scad>");
  folder.write("a.scad", "use <a.scad>\nuse <main.scad>");
  folder.write("bad.scad", "\n}");
  const ParsedDesign design;
  EXPECT_EQ(design.outcome, ParseOutcome::kParsed);
  EXPECT_EQ(design.lines, Lines{"ERROR: Parser error: syntax error in file bad.scad, line 2"});
  EXPECT_EQ(design.program.units.back().scope, nullptr);
}

TEST(Use, TakesFontsAside) {
  const DesignFolder folder;
  folder.write("main.scad", "use <f.TTF>\nuse <no.otf>");
  folder.write("f.TTF", "no font");
  const ParsedDesign design;
  EXPECT_EQ(design.lines, (Lines{"WARNING: Can't open library 'no.otf'.",
                                 "ERROR: Can't read font with path 'no.otf'"}));
  ASSERT_EQ(design.program.units.size(), 1u);
  EXPECT_EQ(design.program.units[0].fonts.size(), 1u);
}

TEST(Use, StandsInNoModule) {
  const ParsedDesign design = parse_text("module m() { use <no.scad> }");
  ASSERT_EQ(design.lines.size(), 4u);
  EXPECT_EQ(design.lines[0], "WARNING: Can't open library 'no.scad'.");
}

TEST(Overwriting, IsWarnedOfDependingOnTheFiles) {
  const DesignFolder folder;
  folder.write("main.scad", "a=1; a=2;\nb=1;\ninclude <inc/i.scad>\nc=2;");
  folder.write("inc/i.scad", "b=2; c=1;\n\nd=1; d=2;\nd=3;");
  const ParsedDesign design;
  EXPECT_EQ(
      design.lines,
      (Lines{"WARNING: a was assigned on line 1 but was overwritten in file main.scad, line 1",
             "WARNING: b was assigned on line 2 of \"main.scad\" but was overwritten in file "
             "inc/i.scad, line 1",
             "WARNING: d was assigned on line 3 of \"inc/i.scad\" but was overwritten in file "
             "inc/i.scad, line 4"}));
  EXPECT_EQ(design.assignments(), (Lines{"a = 2", "b = 2", "c = 2", "d = 3"}));
}

TEST(Overwriting, NamesTheAssignmentBefore) {
  const ParsedDesign design = parse_text("x=1;\nx=2;\nx=3;");
  ASSERT_EQ(design.lines.size(), 2u);
  EXPECT_EQ(design.lines[1],
            "WARNING: x was assigned on line 2 but was overwritten in file <stdin>, line 3");
}

TEST(Overwriting, HoldsForBlocksAndManyNames) {
  const ParsedDesign blocks = parse_text("module m() {x=1;x=2;for(i=1){y=1;{y=2;}}}\n{z=1;}z=2;");
  EXPECT_EQ(blocks.lines.size(), 3u);
  std::string text;
  for (int i = 0; i < 40; ++i) text += "v" + std::to_string(i) + "=1;";
  const ParsedDesign many = parse_text(text + "\nv3=5;v39=6;");
  EXPECT_EQ(many.lines.size(), 2u);
  EXPECT_EQ(many.assignments()[3], "v3 = 5");
  EXPECT_EQ(many.assignments().size(), 40u);
}

TEST(Definitions, ReplaceSilentlyAndMayBeStatements) {
  const DesignFolder folder;
  folder.write("main.scad", "x=1;\ny=2;");
  ParseOptions options;
  options.definitions = {"x=5", "module m() cube()", "z=\"a\""};
  const ParsedDesign design("main.scad", options);
  EXPECT_EQ(design.lines, Lines{});
  EXPECT_EQ(design.assignments(), (Lines{"x = 5", "y = 2", "z = \"a\""}));
  EXPECT_EQ(design.program.units[0].scope->modules.size(), 1u);
  options.definitions = {"}"};
  EXPECT_EQ(ParsedDesign("main.scad", options).lines[0],
            "ERROR: Parser error: syntax error in file main.scad, line 4");
}

TEST(Places, CountCarriageReturnsInCodeOnly) {
  const ParsedDesign design = parse_text("a=1;\r\nb=1;//\r\n\"\r\n\";");
  const ParsedDesign lines = parse_text("a=1;\r\nb=1;/*\r\n*/c=\"\r\n\";\nif (1\n) cube();");
  const Scope& scope = *lines.program.units[0].scope;
  const auto line = [&](Place place) { return lines.program.files.message_line(place); };
  EXPECT_EQ(line(scope.assignments[1].place), 3u);
  EXPECT_EQ(line(scope.assignments[2].place), 4u);
  EXPECT_EQ(line(scope.calls[0].place), 7u);
  EXPECT_EQ(lines.program.files.column(scope.assignments[1].place), 1u);
}

TEST(Calls, AreKeptWithTheirModifiers) {
  const ParsedDesign design = parse_text("#%cube(); *sphere(); !if(1) {} module m() { *cube(); }");
  const Scope& scope = *design.program.units[0].scope;
  ASSERT_EQ(scope.calls.size(), 2u);
  EXPECT_EQ(scope.calls[0].modifiers, kHighlightModifier | kBackgroundModifier);
  EXPECT_EQ(scope.calls[1].modifiers, kRootModifier);
  EXPECT_EQ(scope.calls[1].name, kNoName);
  EXPECT_TRUE(scope.modules[0].content->body->calls.empty());
}

TEST(Links, AreFollowedToLibrariesAndTheMainFolderOnly) {
  const DesignFolder folder;
  folder.write("real/main.scad", "x=1;x=2;include <linked.scad>");
  folder.write("other/library.scad", "y=1;\ny=2;include <near.scad>");
  folder.write("other/near.scad", "z=1;");
  std::filesystem::create_symlink("../other/library.scad", "real/linked.scad");
  std::filesystem::create_symlink("real", "link");
  const ParsedDesign design("link/main.scad");
  EXPECT_EQ(design.lines,
            (Lines{"WARNING: x was assigned on line 1 but was overwritten in file "
                   "../real/main.scad, line 1",
                   "WARNING: y was assigned on line 1 of \"../other/library.scad\" but was "
                   "overwritten in file ../other/library.scad, line 2"}));
  EXPECT_EQ(design.assignments().back(), "z = 1");
  std::filesystem::create_symlink("real/main.scad", "main.scad");
  EXPECT_EQ(ParsedDesign("main.scad").lines[0],
            "WARNING: x was assigned on line 1 but was overwritten in file main.scad, line 1");
}

TEST(HardWarnings, EndTheParsingOfEachFile) {
  const DesignFolder folder;
  folder.write("main.scad", "use <a.scad>\nuse <b.scad>");
  folder.write("a.scad", "\ninclude <no.scad>\n include <no.scad>\n cube();");
  folder.write("b.scad", "x=1;\nx=2\n;\ny=1;");
  ParseOptions options;
  options.hard_warnings = true;
  const ParsedDesign design("main.scad", options);
  EXPECT_EQ(design.outcome, ParseOutcome::kParsed);
  EXPECT_EQ(design.lines,
            (Lines{"WARNING: x was assigned on line 1 of \"b.scad\" but was overwritten in file "
                   "b.scad, line 2",
                   "ERROR: Parser error: stop on first warning in file b.scad, line 3",
                   "WARNING: Can't open include file 'no.scad'.",
                   "ERROR: Parser error: stop on first warning in file a.scad, line 2"}));
}

TEST(HardWarnings, EndTheParsing) {
  ParseOptions options;
  options.hard_warnings = true;
  options.text = "x=1;\nx=2;\ny=1;";
  const ParsedDesign design("-", options);
  EXPECT_EQ(design.outcome, ParseOutcome::kNotParsed);
  ASSERT_EQ(design.lines.size(), 4u);
  EXPECT_EQ(design.lines[1], "ERROR: Parser error: stop on first warning in file <stdin>, line 2");
}

}  // namespace
}  // namespace language
