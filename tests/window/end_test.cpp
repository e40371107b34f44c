// Tests the window among others: resized, iconified, left alone, closed.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <fstream>

#include "designs.hpp"
#include "live_window.hpp"
#include "support/full_run.hpp"

namespace window_test {
namespace {

class ManagedWindow : public LiveWindow {
 protected:
  void SetUp() override {
    if (const auto missing = missing_program({"Xvfb", "xdotool", "openbox"})) {
      GTEST_SKIP() << "no " << *missing;
    }
    LiveWindow::SetUp();
  }
};

TEST_F(ManagedWindow, OtherSizes) {
  const std::string design = folder_.write("a.csg", kBlock);
  open_managed(design);
  const json first = next();
  expect_drawn(design, first);
  for (const auto& [width, height] : {std::pair{501, 350}, {200, 160}, {800, 600}}) {
    display().drive({"windowsize", window_id(), std::to_string(width), std::to_string(height)});
    const json line = next([&, wide = width, high = height](const json& now) {
      return now["width_px"] == wide && now["height_px"] == high;
    });
    EXPECT_EQ(line["camera"], first["camera"]);
    expect_drawn(design, line);
  }
}

TEST_F(ManagedWindow, PutAwayAndBack) {
  const std::string design = folder_.write("a.csg", row_of(2));
  open_managed(design, {"--camera=10,0,0,55,0,25,100"});
  next();
  const auto is_shown = [this] {
    ProcessSetup question;
    question.words = {"xdotool", "search", "--onlyvisible", "--class", "scadray"};
    question.environment["DISPLAY"] = display().name();
    return Process(question).wait() == 0;
  };
  const std::string id = window_id();
  display().drive({"windowminimize", id});
  ASSERT_TRUE(wait_until([&] { return !is_shown(); }));
  folder_.write("a.csg", row_of(5));
  display().drive({"windowmap", id});
  ASSERT_TRUE(wait_until(is_shown));
  expect_drawn(design, next_of(5));
}

TEST_F(ManagedWindow, ItsCloseButton) {
  open_managed(folder_.write("a.csg", kBlock));
  next();
  display().drive({"windowactivate", "--sync", window_id()});
  // The window manager drops a key that comes before the focus that it has just given.
  EXPECT_TRUE(wait_until([this] {
    display().drive({"key", "alt+F4"});
    const auto next_press = std::chrono::steady_clock::now() + std::chrono::seconds{1};
    while (!program().ended() && std::chrono::steady_clock::now() < next_press) {
      std::this_thread::sleep_for(std::chrono::milliseconds{2});
    }
    return program().ended().has_value();
  }));
  EXPECT_EQ(program().ended(), 0);
  EXPECT_EQ(errors(), "");
}

using Ending = LiveWindow;

TEST_F(Ending, ByKeys) {
  for (const char* name : {"ctrl+q", "ctrl+w"}) {
    open(folder_.write("a.csg", kBlock));
    next();
    key(name);
    EXPECT_EQ(program().wait(), 0);
    EXPECT_EQ(errors(), "");
  }
}

/// A program in openscad's place that never ends, with another one that it starts.
class EndingDuringAnExport : public LiveWindow {
 protected:
  void start() {
    openscad_ = std::make_unique<frontend::Environment>(
        "OPENSCAD", folder_.script("openscad", "sleep 1000 & echo $! >'" + (folder_ / "new") +
                                                   "'; mv '" + (folder_ / "new") + "' '" +
                                                   (folder_ / "running") + "'; wait"));
    open(folder_.write("a.scad", "cube(1);\n"), {"--evaluator=openscad"});
    ASSERT_TRUE(wait_until([this] { return folder_.has("running"); }));
    exporting_ = std::stoi(folder_.read("running"));
    EXPECT_TRUE(is_running(exporting_));
    // The guard (child_process.hpp) may be the later one to start.
    EXPECT_TRUE(wait_until([this] { return children(program().pid()) == 2; }));
  }
  void expect_nothing_left() {
    EXPECT_TRUE(wait_until([this] { return !is_running(exporting_); }));
  }

 private:
  std::unique_ptr<frontend::Environment> openscad_;
  pid_t exporting_ = 0;
};

TEST_F(EndingDuringAnExport, ByASignal) {
  start();
  program().send(SIGTERM);
  EXPECT_EQ(program().wait(), 1);
  expect_nothing_left();
}

TEST_F(EndingDuringAnExport, ByAKill) {
  start();
  program().send(SIGKILL);
  EXPECT_EQ(program().wait(), 128 + SIGKILL);
  expect_nothing_left();
}

TEST_F(EndingDuringAnExport, ByAKey) {
  start();
  window_id();  // waits until it is open
  key("ctrl+q");
  EXPECT_EQ(program().wait(), 0);
  EXPECT_EQ(errors(), "");
  expect_nothing_left();
}

using Idle = LiveWindow;

TEST_F(Idle, TakesNoTime) {
  const std::chrono::seconds time(test_support::full_run() ? 10 : 2);
  std::cout << "over " << time.count() << " s\n";
  open(folder_.write("a.csg", kBlock));
  next();
  // Measured after ImGui's last frames and the finer picture, which come late on a busy machine.
  // The bar is a hundredth of a processor: one tick a second.
  const pid_t pid = program().pid();
  EXPECT_TRUE(wait_until([&] {
    const long before = used_ticks(pid);
    std::this_thread::sleep_for(time);
    return used_ticks(pid) - before <= time.count();
  })) << "it is never idle";
}

}  // namespace
}  // namespace window_test
