// What the window shows when it opens, and where it cannot open.
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
  // The whole design, as without --camera.
  const std::string path = folder_ / "whole.png";
  ProcessSetup setup;
  setup.words = {SCADRAY_PROGRAM, "-o", path, "--imgsize=400,300", design};
  run(setup);
  expect_shown(read_png(path));
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
  const std::string design =
      folder_.write("a.csg", kBlock + "minkowski(convexity = 0) {\n\tcube(size = [1, 1, 1]);\n}\n");
  open(design);
  const json line = next();
  EXPECT_EQ(line["error"], "");
  EXPECT_THAT(line["messages"].get<std::vector<std::string>>(),
              ElementsAre(AllOf(HasSubstr("a.csg:7:1: warning: "), HasSubstr("minkowski"))));
  const Picture with_messages = shown();
  key("m");  // they go
  wait_until_other(with_messages);
  expect_drawn(design, line, {"--skip-unsupported", "-q"});
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

}  // namespace
}  // namespace window_test
