// Tests what the window shows when it opens, and the cases in which it cannot open.
#include <gmock/gmock.h>

#include "designs.hpp"
#include "live_window.hpp"

namespace window_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

using Opening = LiveWindow;

TEST_F(Opening, ShowsThePictureOfTheCommandInItsSize) {
  const std::string design = folder_.write("a.csg", kBlock);
  open(design);
  const json line = next();
  EXPECT_EQ(line["width_px"], kWidth);
  EXPECT_EQ(line["height_px"], kHeight);
  EXPECT_EQ(line["version"], 1);
  EXPECT_EQ(line["primitives"], 2);
  EXPECT_GT(line["save_to_screen_ms"].get<double>(), 0);
  EXPECT_THAT(line["status"].get<std::string>(),
              AllOf(StartsWith("2 primitives  |  parse "), HasSubstr(", draw "),
                    HasSubstr("  |  400 x 300")));
  EXPECT_EQ(title(), "a.csg - scadray");
  expect_drawn(design, line);
}

/// Neither what is cut away nor the panels hide what is left.
TEST_F(Opening, FramesWhatIsLeft) {
  const std::string cut =
      "difference() { cube(size = [10, 20, 90]); cube(size = [30, 30, 80]); }\n";
  const csgcore::Box left{{0, 0, 80}, {10, 20, 90}};
  open(folder_.write("a.csg", cut));
  const Taken alone = taken_by(left, next());
  EXPECT_TRUE(0 <= alone.left && alone.right <= kWidth);
  EXPECT_TRUE(20 <= alone.top && alone.bottom <= kHeight - 25);
  EXPECT_GT(alone.bottom - alone.top, 0.75 * kHeight);
  // The panel of the messages takes the lower end.
  open(folder_.write("b.scad", "echo(1);\n" + cut));
  const Taken above = taken_by(left, next());
  EXPECT_TRUE(20 <= above.top && above.bottom <= kHeight - 85);
  EXPECT_GT(above.bottom - above.top, 0.5 * kHeight);
}

TEST_F(Opening, TakesTheOptionsOfPictures) {
  const std::string design = folder_.write("a.csg", kBlock);
  const std::vector<std::string> options = {"--camera=1,2,3,40,50,60,90", "--projection=o",
                                            "--colorscheme=Starnight", "--shading=phong",
                                            "--samples=4"};
  open(design, options);
  const json line = next();
  EXPECT_EQ(camera_option(line["camera"]), options[0]);
  EXPECT_TRUE(line["camera"]["orthographic"]);
  expect_drawn(design, line, {options.begin() + 2, options.end()});
}

TEST_F(Opening, AnEmptyDesignIsTheBackground) {
  open(folder_.write("a.csg", "\n"));
  const json line = next();
  EXPECT_EQ(line["primitives"], 0);
  EXPECT_EQ(line["error"], "");
  const Picture background{kWidth, kHeight, {kWidth * kHeight, {0xff, 0xff, 0xe5}}};
  expect_shown(background);
}

TEST_F(Opening, StandardInput) {
  ProcessSetup setup;
  setup.input = folder_.write("a.csg", kBlock);
  open("-", {}, setup);
  const json line = next();
  EXPECT_EQ(line["primitives"], 2);
  EXPECT_EQ(title(), "standard input - scadray");
  expect_drawn(setup.input, line);
}

TEST_F(Opening, WhatCannotBeDrawnIsLeftOutAndListed) {
  const std::string design = folder_.write("a.csg", kBlock + "cube(size = 1e308);\n");
  open(design);
  const json line = next();
  EXPECT_EQ(line["error"], "");
  EXPECT_THAT(line["messages"].get<std::vector<std::string>>(),
              ElementsAre(AllOf(HasSubstr("a.csg:7:1: warning: "), HasSubstr("cube is left out"))));
  const Picture with_messages = shown();
  key("m");  // hides the messages
  wait_until_other(with_messages);
  expect_drawn(design, line, {"-q"});
}

TEST_F(Opening, AScadWithoutASuffix) {
  if (missing_program({"openscad"})) GTEST_SKIP() << "no openscad";
  const std::string design =
      folder_.write("scad-x7Qf", "module two() cube(9);\ntwo();\nsphere(6);");
  open(design);
  const json line = next();
  EXPECT_EQ(line["error"], "");
  EXPECT_EQ(line["primitives"], 2);
  EXPECT_GT(line["times_ms"]["export"].get<double>(), 0);
  expect_drawn(design, line);
}

/// Returns whether the whole of a status line of that height is within the window: its right margin
/// is empty.
bool is_status_whole(const Picture& shown, uint32_t height) {
  constexpr uint32_t kMargin = 6;  // less than ImGui's
  const uint32_t bottom = shown.height - kMargin;
  for (uint32_t y = shown.height - height + kMargin; y < bottom; ++y) {
    for (uint32_t x = shown.width - kMargin; x < shown.width - 1; ++x) {
      if (shown.at(x, y) != shown.at(x, bottom)) return false;
    }
  }
  return true;
}

TEST_F(Opening, TheStatusLineIsWholeInNarrowWindows) {
  constexpr uint32_t kLine = 16;
  const std::string design = folder_.write("a.csg", kBlock);
  for (const int width : {640, 200}) {
    SCOPED_TRACE(width);
    open(design, {"--imgsize=" + std::to_string(width) + ",300", "--show=cells"});
    const json line = next();
    EXPECT_GT(7 * line["status"].get<std::string>().size(), 640u);  // a letter is 7 pixels wide
    EXPECT_TRUE(wait_until([this] { return is_status_whole(shown(), kLine); }));
  }
  // The notice that a picture cannot have this name is wrapped.
  const Picture before = shown();
  key("ctrl+s");
  wait_until_settled(before);
  display().drive({"key", "ctrl+a", "type", "x.bmp"});
  wait_until_settled(before);
  const Picture dialogue = shown();
  key("Return");
  wait_until_settled(dialogue);
  EXPECT_TRUE(is_status_whole(shown(), 6 * kLine));
}

TEST_F(Opening, WithoutADisplayItSaysSo) {
  for (const auto& display : {std::optional<std::string>(), std::optional<std::string>(":9999")}) {
    ProcessSetup setup;
    setup.words = {SCADRAY_PROGRAM, folder_.write("a.csg", kBlock)};
    setup.environment = {{"DISPLAY", display}, {"WAYLAND_DISPLAY", std::nullopt}};
    setup.errors = folder_ / "errors";
    EXPECT_EQ(Process(setup).wait(), 1);
    EXPECT_THAT(errors(), AllOf(StartsWith("error: no window can be opened: "),
                                HasSubstr("(set DISPLAY; or draw without a window: ")));
  }
}

TEST_F(Opening, StatisticsThatCannotBeWritten) {
  ProcessSetup setup;
  setup.words = {SCADRAY_PROGRAM, "--stats=" + (folder_ / "none/stats"),
                 folder_.write("a.csg", kBlock)};
  setup.environment["DISPLAY"] = display().name();
  setup.errors = folder_ / "errors";
  EXPECT_EQ(Process(setup).wait(), 1);
  EXPECT_THAT(errors(),
              AllOf(HasSubstr("none/stats: error: cannot be written: "), HasSubstr("--stats")));
}

TEST_F(Opening, StatisticsThatWouldOverwriteTheDesign) {
  const std::string design = folder_.write("a.csg", kBlock);
  ProcessSetup setup;
  setup.words = {SCADRAY_PROGRAM, "--stats=" + design, design};
  setup.errors = folder_ / "errors";
  EXPECT_EQ(Process(setup).wait(), 1);
  EXPECT_THAT(errors(), HasSubstr("a.csg: error: --stats would overwrite the design ("));
  EXPECT_EQ(folder_.read("a.csg"), kBlock);
}

}  // namespace
}  // namespace window_test
