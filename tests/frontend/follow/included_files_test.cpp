// Tests which files a .scad includes.
#include "follow/included_files.hpp"

#include <gmock/gmock.h>

#include "temporary_folder.hpp"

namespace frontend {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

TEST(IncludedNames, AreThoseOfTheLanguage) {
  EXPECT_THAT(included_names("include <a.scad>\nuse<b c.scad>;include\n\t<../d>sphere();use <e>"),
              ElementsAre("a.scad", "b c.scad", "../d", "e"));
}

TEST(IncludedNames, AreNotInCommentsAndStrings) {
  EXPECT_THAT(included_names("// include <a>\n/* use <b>\n * use <c> **/ x = \"include <d>\";\n"
                             "y = \"\\\" use <e> \\\\\"; include <f>"),
              ElementsAre("f"));
}

TEST(IncludedNames, OtherWordsAndDamagedText) {
  EXPECT_THAT(included_names("reuse <a> used <b> include_ <c> use < include <\n>use <>"),
              IsEmpty());
  for (const char* text :
       {"", "use", "use <", "use <a", "/*", "//", "\"", "\"\\", "/", "include "}) {
    EXPECT_THAT(included_names(text), IsEmpty()) << text;
  }
}

TEST(IncludedFiles, AreFoundThroughOneAnother) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "lib");
  const std::string a = folder.write("a.scad", "include <lib/b.scad>\ninclude <lib/../d.scad>");
  const std::string b = folder.write("lib/b.scad", "use <c.scad>\ninclude <../a.scad>");
  const std::string c = folder.write("lib/c.scad", "");
  const std::string d = folder.write("d.scad", "");
  IncludedFiles files;
  EXPECT_THAT(files.of(a), ElementsAre(a, b, d, c));
  folder.write("lib/c.scad", "use <e.scad>");
  folder.write("lib/e.scad", "");
  EXPECT_THAT(files.of(a), ElementsAre(a, b, d, c, folder / "lib/e.scad"));
  folder.write("a.scad", "");
  EXPECT_THAT(files.of(a), ElementsAre(a));
}

TEST(IncludedFiles, AreLookedForWhereOpenScadDoes) {
  const TemporaryFolder folder;
  for (const char* name : {"one", "two", ".local"}) {
    std::filesystem::create_directory(folder / name);
  }
  const Environment libraries("OPENSCADPATH", folder / "one:" + (folder / "two"));
  const Environment home("HOME", folder.path());
  const std::string a = folder.write("a.scad", "use <b.scad>");
  IncludedFiles files;
  const std::vector<std::string> missing = files.of(a);
  for (const std::string& place : {folder / "b.scad", folder / "one/b.scad", folder / "two/b.scad",
                                   folder / ".local/share/OpenSCAD/libraries/b.scad"}) {
    EXPECT_THAT(missing, Contains(place));
  }
  folder.write("two/b.scad", "");
  EXPECT_THAT(files.of(a), ElementsAre(a, folder / "two/b.scad"));
  folder.write("b.scad", "");
  EXPECT_THAT(files.of(a), ElementsAre(a, folder / "b.scad"));
}

TEST(IncludedFiles, MayBeFonts) {
  const TemporaryFolder folder;
  const std::string a = folder.write("a.scad", "use <b.scad>\nuse <missing.ttf>");
  const std::string b = folder.write("b.scad", "use <c.TTF>\nuse <d.otf>\nuse <c.scad>");
  const std::string c = folder.write("c.TTF", "use <e.scad>");
  const std::string d = folder.write("d.otf", "");
  folder.write("c.scad", "");
  folder.write("e.scad", "");
  IncludedFiles files;
  EXPECT_THAT(files.fonts_of(a), ElementsAre(c, d));
  EXPECT_THAT(files.of(a), Not(Contains(folder / "e.scad"))) << "a font includes nothing";
  EXPECT_THAT(files.of(a), Contains(folder / "missing.ttf"));
}

TEST(IncludedFiles, ThatCannotBeReadIncludeNothing) {
  const TemporaryFolder folder;
  const std::string a = folder.write("a.scad", "use <b.scad>");
  std::filesystem::create_directory(folder / "b.scad");
  IncludedFiles files;
  EXPECT_THAT(files.of(a), Contains(folder / "b.scad"));
  EXPECT_THAT(files.of(folder / "none.scad"), ElementsAre(folder / "none.scad"));
}

}  // namespace
}  // namespace frontend
