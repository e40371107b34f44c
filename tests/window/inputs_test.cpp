// Tests the customizer and the animation in the window.
#include <gmock/gmock.h>

#include "designs.hpp"
#include "live_window.hpp"

namespace window_test {
namespace {

constexpr const char* kDesign =
    "n = 1; // [1:9]\n$vpr = [0, 0, 360 * $t];\n"
    "for (i = [1 : n]) translate([3 * i, 0, 10 * $t]) sphere();\n";

class WindowInputs : public LiveWindow {
 protected:
  std::string design_ = folder_.write("a.scad", kDesign);
};

TEST_F(WindowInputs, ASliderMovesTheDesign) {
  open(design_);
  next_of(1);
  const Picture before = shown();
  key("ctrl+p");
  wait_until_settled(before);
  // The slider is the last thing in the panel.
  const auto point_at = [this](const char* x) { display().drive({"mousemove", x, "133"}); };
  const Picture panel = shown();
  point_at("60");
  wait_until_settled(panel);
  display().drive({"mousedown", "1"});
  point_at("390");
  EXPECT_EQ(next_of(9)["error"], "");
  point_at("20");
  next_of(1);
  point_at("390");
  next_of(9);
  display().drive({"mouseup", "1"});
  EXPECT_EQ(folder_.read("a.scad"), kDesign);
  folder_.write("a.scad", std::string(kDesign) + "cube();");
  next_of(10);
}

TEST_F(WindowInputs, AnExportHasTheSlidersValue) {
  open(design_);
  next_of(1);
  const Picture before = shown();
  key("ctrl+p");
  wait_until_settled(before);
  display().drive({"mousemove", "60", "133", "sleep", "0.1", "mousedown", "1"});
  display().drive({"mousemove", "390", "133"});
  next_of(9);
  display().drive({"mouseup", "1"});
  const Picture panel = shown();
  key("F7");
  wait_until_settled(panel);
  key("Return");
  EXPECT_TRUE(wait_until([&] { return folder_.has("a.stl"); }));
  ProcessSetup setup;
  setup.words = {SCADRAY_PROGRAM, "-o", folder_ / "wanted.stl", "-D", "n=9", design_};
  run(setup);
  EXPECT_TRUE(folder_.read("a.stl") == folder_.read("wanted.stl"));
}

/// While a frame is drawn, the mouse may have gone on, and its button up.
TEST_F(WindowInputs, ASliderStaysWhereItIsLeft) {
  open(design_);
  next_of(1);
  const Picture before = shown();
  key("ctrl+p");
  wait_until_settled(before);
  for (int round = 0; round < 5; ++round) {
    display().drive({"mousemove", "60", "133", "sleep", "0.1", "mousedown", "1"});
    display().drive({"mousemove", "150", "133"});
    next([](const json& line) { return line["primitives"].get<int>() > 3; });
    display().drive(
        {"mousemove", "120", "133", "mouseup", "1", "mousemove", "390", "133", "sleep", "0.3"});
    folder_.write("a.scad", kDesign + std::string(static_cast<std::size_t>(round), '\n'));
    const json saved = next([](const json& line) { return line.contains("save_to_screen_ms"); });
    EXPECT_LE(saved["primitives"].get<int>(), 7);
  }
}

TEST_F(WindowInputs, AnAnimationPlaysAndTurnsTheCamera) {
  open(design_);
  const json first = next_of(1);
  EXPECT_EQ(first["camera"]["rotation_deg"], json({0.0, 0.0, 0.0}));
  key("space");
  next([](const json& line) { return line["camera"]["rotation_deg"][2].get<double>() > 30; });
  key("space");
  key("a");  // closes the panel, and the time is 0 again
  next([](const json& line) { return line["camera"]["rotation_deg"][2].get<double>() == 0; });
}

TEST_F(WindowInputs, AnAnimationThatWasStoppedPlaysOn) {
  // Only the second of its hundred frames takes long.
  folder_.write("a.scad",
                "function f(n) = n < 2 ? n : f(n - 1) + f(n - 2);\n"
                "cube($t == 0.01 ? f(99) : 1 + $t); for (i = [0 : 100 * $t]) sphere();\n");
  open(design_);
  next_of(2);
  const Picture before = shown();
  key("space");
  wait_until_settled(before);  // the panel, and then the progress
  wait_until_other(shown());
  key("Escape");
  key("space");
  next([](const json& line) { return line["primitives"].get<int>() > 3; });
}

}  // namespace
}  // namespace window_test
