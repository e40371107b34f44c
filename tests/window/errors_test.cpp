// Tests what the window does with errors: a click opens their place in the editor, whichever file
// it is in, and the last good picture stays.
#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "live_window.hpp"

namespace window_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class Errors : public LiveWindow {
 protected:
  /// Opens a design with an editor that writes down what it is to open, and without messages but
  /// errors.
  void open_with_editor(const std::string& design) {
    const std::string editor =
        folder_.script("edit", "echo \"$1\" > \"$0.new\"; mv \"$0.new\" \"$0.words\"");
    // So wide that no error takes two lines.
    open(design, {"--imgsize=1200,300", "--editor='" + editor + "' {file}:{line}"});
    next();
    const Picture with_tabs = shown();
    key("m");
    wait_until_settled(with_tabs);
  }
  /// Clicks on the first line of the errors' panel, and returns what the editor is to open.
  std::string opened() {
    constexpr uint32_t kX = 40, kBelowMenu = 40, kFirstLine = 15, kDark = 100;
    constexpr std::chrono::milliseconds kSomeFrames(100);  // in which a panel finds its place
    uint32_t top = 0;
    const bool has_panel = wait_until([&] {
      const uint32_t before = top;
      std::this_thread::sleep_for(kSomeFrames);
      const Picture now = shown();
      for (top = kBelowMenu; top < now.height && now.at(kX, top)[2] > kDark;) ++top;
      return top == before && top + 2 * kFirstLine < now.height - kFirstLine;
    });
    if (!has_panel) return "no panel";
    click(kX, static_cast<int>(top + kFirstLine));
    if (!wait_until([&] { return folder_.has("edit.words"); })) return "nothing";
    const std::string words = folder_.read("edit.words");
    std::filesystem::remove(folder_ / "edit.words");
    return words.substr(0, words.find('\n'));
  }
};

TEST_F(Errors, AreOpenedWhereTheyAre) {
  std::filesystem::create_directory(folder_ / "lib");
  for (const char* name : {"bad.scad", "lib/bad.scad"}) {
    folder_.write(name, "module bad() {\n  assert(false);\n}\n");
    folder_.write(std::string(name).replace(std::string(name).find("bad"), 3, "cut"),
                  "module cut() {\n\n  cube(1;\n}\n");
  }
  const struct {
    const char* text;
    const char* place;
  } cases[] = {{"cube(1);\nassert(false);\n", "a.scad:2"},
               {"cube(1);\n\nsphere(8;\n", "a.scad:3"},
               {"use <lib/bad.scad>\nbad();\n", "lib/bad.scad:2"},
               {"include <lib/bad.scad>\nbad();\n", "lib/bad.scad:2"},
               {"include <lib/cut.scad>\ncut();\n", "lib/cut.scad:3"},
               {"use <lib/cut.scad>\ncube(1);\n", "lib/cut.scad:3"}};
  const std::string design = folder_.write("a.scad", cases[0].text);
  open_with_editor(design);
  int version = 1;
  for (const auto& [text, place] : cases) {
    SCOPED_TRACE(text);
    if (text != cases[0].text) {
      folder_.write("a.scad", text);
      ++version;
      next([&](const json& line) { return line["version"] == version; });
    }
    EXPECT_EQ(opened(), std::filesystem::canonical(folder_.path()).string() + '/' + place);
  }
}

TEST_F(Errors, OfAUsedFileKeepTheLastGoodPicture) {
  constexpr Area kAboveTheError{0, 30, kWidth, 120};
  std::filesystem::create_directory(folder_ / "lib");
  folder_.write("lib/part.scad", "module part() { cube(10); }\n");
  const std::string design = folder_.write("a.scad", "use <lib/part.scad>\npart();\nsphere(8);\n");
  open(design);
  next_of(2);
  const Picture good = shown();
  folder_.write("lib/part.scad", "module part() {\n cube(10; }\n");
  const json broken = next_error();
  EXPECT_THAT(broken["error"].get<std::string>(), StartsWith(folder_ / "lib/part.scad:2: error: "));
  EXPECT_EQ(broken["primitives"], 2);
  EXPECT_EQ(title(), "a.scad - error - scadray");
  wait_until_other(good);  // the window says so
  expect_shown(good, kAboveTheError);
  folder_.write("lib/part.scad", "module part() { cube(10); sphere(9); }\n");
  expect_drawn(design, next_of(3));
  EXPECT_EQ(title(), "a.scad - scadray");
}

/// Without a good picture there is what OpenSCAD draws.
TEST_F(Errors, OfAUsedFileAreInTheTitleFromTheStart) {
  folder_.write("part.scad", "module part() { cube(10; }\n");
  open(folder_.write("a.scad", "use <part.scad>\npart();\nsphere(8);\n"));
  EXPECT_EQ(next_of(1)["messages"].size(), 2u);
  EXPECT_EQ(title(), "a.scad - error - scadray");
  folder_.write("a.scad", "use <part.scad>\nsphere(8); sphere(7);\n");
  next_of(2);
}

}  // namespace
}  // namespace window_test
