// Tests how other designs are opened, and what the window remembers from run to run.
#include <gmock/gmock.h>
#include <signal.h>

#include <filesystem>

#include "designs.hpp"
#include "drop_files.hpp"
#include "live_window.hpp"

namespace window_test {
namespace {

using testing::HasSubstr;

/// What -o does not draw unless it is asked for is switched off.
const std::string kPlain = "grid=off\norientation=off\n";

class OpenDesign : public LiveWindow {
 protected:
  OpenDesign() {
    setup_.environment["XDG_STATE_HOME"] = folder_ / "state";
    std::filesystem::create_directories(folder_ / "state/scadray");
    folder_.write("state/scadray/window", kPlain);
    folder_.write("block.csg", kBlock);
    folder_.write("row.csg", row_of(3));
  }
  json open_block(const std::vector<std::string>& options = {}) {
    open(folder_ / "block.csg", options, setup_);
    window_id();
    return first_ = next_of(2);
  }
  /// Ends the window as its user does.
  void close() {
    key("ctrl+q");
    EXPECT_EQ(program().wait(), 0);
    EXPECT_EQ(errors(), "");
  }
  /// Expects that the window shows the row as if it were opened with it.
  void expect_row() {
    const json line = next_of(3);
    EXPECT_EQ(title(), "row.csg - scadray");
    EXPECT_EQ(line["version"], 1);
    EXPECT_NE(line["camera"], first_["camera"]);  // the whole row is in the picture
    expect_drawn(folder_ / "row.csg", line);
  }
  std::string remembered() const { return folder_.read("state/scadray/window"); }
  ProcessSetup setup_;
  json first_;  // of the block
};

TEST_F(OpenDesign, ByTheDialogue) {
  open_block();
  const Picture before = shown();
  // Esc leaves the dialogue; a part of a name and Enter open.
  display().drive({"key", "ctrl+o", "type", "row"});
  wait_until_settled(before);
  key("Escape");
  expect_shown(before, {0, 0, kWidth, kHeight});
  display().drive({"key", "ctrl+o", "type", "ow"});
  key("Return");
  expect_row();
  // The design that is gone is followed no more, the new one is.
  folder_.write("block.csg", row_of(7));
  folder_.write("row.csg", row_of(4));
  EXPECT_EQ(next()["primitives"], 4);
  close();
  EXPECT_EQ(remembered(), kPlain + "recent=" + (folder_ / "row.csg") +
                              "\nrecent=" + (folder_ / "block.csg") + "\n");
}

TEST_F(OpenDesign, ByTheMenuOfRecentOnes) {
  folder_.write("state/scadray/window", kPlain + "recent=" + (folder_ / "none.csg") +
                                            "\nrecent=" + (folder_ / "row.csg") + "\n");
  open_block();
  const Picture before = shown();
  // The block itself is the first.
  display().drive({"key", "--delay", "1", "F10", "Down", "Right", "Down", "Return"});
  wait_until_other(before);  // there is no such file, and the status line says so
  display().drive({"key", "--delay", "1", "F10", "Down", "Right", "Down", "Down", "Return"});
  expect_row();
}

TEST_F(OpenDesign, ByDroppingFiles) {
  open_block();
  ASSERT_TRUE(drop_files(display().name(), std::stoul(window_id()),
                         {folder_ / "row.csg", folder_ / "block.csg"}));
  expect_row();
  // The other file has a window of its own.
  EXPECT_TRUE(wait_until([&] { return children(program().pid()) == 1; }));
  const std::string others =
      display().drive({"search", "--sync", "--name", "^block.csg - scadray"});
  EXPECT_NE(others, "");
  display().drive({"windowkill", others.substr(0, others.find('\n'))});
  EXPECT_TRUE(wait_until([&] { return children(program().pid()) == 0; }));
}

TEST_F(OpenDesign, SeveralOnTheCommandLine) {
  setup_.words = {SCADRAY_PROGRAM, "--imgsize=400,300", folder_ / "block.csg", folder_ / "row.csg"};
  setup_.environment["DISPLAY"] = display().name();
  setup_.environment["WAYLAND_DISPLAY"] = std::nullopt;
  setup_.errors = folder_ / "errors";
  Process windows(setup_);
  std::vector<std::string> ids;
  for (const char* name : {"block", "row"}) {
    const std::string found =
        display().drive({"search", "--sync", "--name", std::string("^") + name + ".csg - scadray"});
    ids.push_back(found.substr(0, found.find('\n')));
  }
  display().drive({"windowfocus", "--sync", ids[0], "key", "ctrl+q"});
  EXPECT_EQ(windows.ended(), std::nullopt) << "the other window is open";
  display().drive({"windowfocus", "--sync", ids[1], "key", "ctrl+q"});
  EXPECT_EQ(windows.wait(), 0);
  EXPECT_EQ(errors(), "");
}

TEST_F(OpenDesign, ASignalEndsAllWindows) {
  setup_.words = {SCADRAY_PROGRAM, folder_ / "block.csg", folder_ / "row.csg"};
  setup_.environment["DISPLAY"] = display().name();
  Process windows(setup_);
  ASSERT_TRUE(wait_until([&] { return children(windows.pid()) == 1; }));
  display().drive({"search", "--sync", "--name", "^row.csg - scadray"});
  windows.send(SIGTERM);
  EXPECT_EQ(windows.wait(), 1);
  EXPECT_TRUE(wait_until([&] {
    ProcessSetup question;
    question.words = {"xdotool", "search", "--name", "scadray"};
    question.environment["DISPLAY"] = display().name();
    return Process(question).wait() != 0;
  }));
}

TEST_F(OpenDesign, WhatIsSwitchedOnIsRemembered) {
  open_block();
  key("ctrl+2");
  next();
  close();
  expect_drawn(folder_ / "block.csg", open_block(), {"--view=axes"});
  key("g");
  next();
  close();
  EXPECT_THAT(remembered(), HasSubstr("grid=on\n"));
  // The command line wins, and is not remembered.
  const std::vector<std::string> options = {"--view=crosshairs", "--render",
                                            "--colorscheme=Metallic"};
  expect_drawn(folder_ / "block.csg", open_block(options), options);
  close();
  EXPECT_THAT(remembered(), HasSubstr("axes=on\n"));
  EXPECT_THAT(remembered(), Not(HasSubstr("colours=")));
}

TEST_F(OpenDesign, SizeAndPositionAreRemembered) {
  const auto place = [this] {
    return display()
        .drive({"getwindowgeometry", "--shell", window_id()})
        .substr(std::string("WINDOW=").size() + window_id().size());
  };
  open_block();
  display().drive({"windowsize", window_id(), "500", "350", "windowmove", window_id(), "70", "90"});
  next([](const json& line) { return line["width_px"] == 500; });
  const std::string before = place();
  EXPECT_THAT(before, HasSubstr("X=70\nY=90\nWIDTH=500\nHEIGHT=350"));
  // It is written soon, also if the window is killed.
  EXPECT_TRUE(wait_until([&] { return remembered().find("position=70 90") != std::string::npos; }));
  program().send(SIGKILL);
  program().wait();
  gives_size_ = false;
  open_block();
  EXPECT_EQ(place(), before);
}

}  // namespace
}  // namespace window_test
