// Tests the folder's entries of the dialogue that opens a design, and what is chosen of them.
#include "file_browser.hpp"

#include <gmock/gmock.h>

#include "temporary_folder.hpp"

namespace window {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class FileBrowserTest : public testing::Test {
 protected:
  FileBrowserTest() {
    for (const char* name : {"Parts", "parts/old", ".hidden"}) {
      std::filesystem::create_directories(folder_ / name);
    }
    for (const char* name : {"b.scad", "A.SCAD", "ab.csg", "notes.txt", ".x.scad", "parts/c.stl"}) {
      folder_.write(name, "");
    }
  }
  static std::vector<std::string> names(const FileBrowser& browser) {
    std::vector<std::string> names;
    for (const FileBrowser::Entry& entry : browser.entries()) {
      names.push_back(entry.name + (entry.is_folder ? "/" : ""));
    }
    return names;
  }
  static std::string chosen(const FileBrowser& browser) {
    return browser.entries().empty() ? "" : browser.entries()[browser.chosen()].name;
  }
  frontend::TemporaryFolder folder_;
};

TEST_F(FileBrowserTest, ShowsFoldersThenDesigns) {
  const FileBrowser browser(folder_.path());
  EXPECT_THAT(names(browser), ElementsAre("../", "Parts/", "parts/", "A.SCAD", "ab.csg", "b.scad"));
  EXPECT_EQ(chosen(browser), "Parts");
  EXPECT_EQ(browser.problem(), "");
}

TEST_F(FileBrowserTest, ATextChoosesByPartsOfNames) {
  FileBrowser browser(folder_.path());
  browser.type("B");
  EXPECT_THAT(names(browser), ElementsAre("ab.csg", "b.scad"));
  EXPECT_EQ(chosen(browser), "b.scad");
  browser.move(-5);
  EXPECT_EQ(chosen(browser), "ab.csg");
  EXPECT_EQ(browser.completed(), "ab.csg");
  EXPECT_EQ(browser.enter(), folder_ / "ab.csg");
  browser.type(".");
  EXPECT_THAT(names(browser), testing::Contains(".x.scad"));
  browser.type("nothing");
  EXPECT_THAT(names(browser), IsEmpty());
  browser.move(1);
  EXPECT_EQ(browser.enter(), std::nullopt);
  EXPECT_THAT(browser.problem(), HasSubstr("no such file: nothing"));
  browser.type("notes.txt");  // is not shown
  EXPECT_EQ(browser.enter(), folder_ / "notes.txt");
}

TEST_F(FileBrowserTest, ATextIsAPathUpToItsLastSlash) {
  FileBrowser browser(folder_.path());
  browser.type("parts/");
  EXPECT_EQ(browser.folder(), folder_ / "parts");
  EXPECT_THAT(names(browser), ElementsAre("../", "old/", "c.stl"));
  browser.type("parts/c");
  EXPECT_EQ(browser.completed(), "parts/c.stl");
  EXPECT_EQ(browser.enter(), folder_ / "parts/c.stl");
  browser.type("none/c");
  EXPECT_THAT(names(browser), IsEmpty());
  EXPECT_THAT(browser.problem(), HasSubstr("cannot be read"));
  browser.type("");
  EXPECT_EQ(browser.folder(), folder_.path());
  const frontend::Environment home("HOME", folder_.path());
  browser.type("~/parts/");
  EXPECT_EQ(browser.folder(), folder_ / "parts");
  browser.type("/");
  EXPECT_EQ(browser.folder(), "/");
}

TEST_F(FileBrowserTest, GoesIntoFoldersAndUp) {
  FileBrowser browser(folder_ / "Parts");
  browser.go_up();
  EXPECT_EQ(browser.folder(), folder_.path());
  EXPECT_EQ(chosen(browser), "Parts");
  browser.move(1);
  EXPECT_EQ(browser.enter(), std::nullopt);
  EXPECT_EQ(browser.folder(), folder_ / "parts");
  browser.choose(0);
  EXPECT_EQ(browser.enter(), std::nullopt);
  EXPECT_EQ(browser.folder(), folder_.path());
  EXPECT_EQ(chosen(browser), "parts");
}

}  // namespace
}  // namespace window
