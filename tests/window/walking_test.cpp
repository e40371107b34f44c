// Tests that keys alone do what the mouse does: they move the view, walk along menus and panels,
// and Esc leads back to the picture.
#include <gmock/gmock.h>

#include "designs.hpp"
#include "live_window.hpp"

namespace window_test {
namespace {

using csgcore::Vec3;

class Walking : public LiveWindow {
 protected:
  json start(const std::string& text = kBlock, const std::vector<std::string>& options = {}) {
    design_ = folder_.write(text == kBlock ? "a.csg" : "a.scad", text);
    open(design_, options);
    const json first = next();
    window_id();
    return first;
  }
  /// Presses keys, one right after the other, and waits until the window stands still.
  void press(std::vector<std::string> names) {
    const Picture before = shown();
    names.insert(names.begin(), {"key", "--delay", "1"});
    display().drive(names);
    wait_until_settled(before);
  }
  std::string design_;
};

TEST_F(Walking, ArrowsTurnAndPanAndSignsZoom) {
  frontend::Camera camera = camera_of(start());
  const auto turned = [&](const char* name, const Vec3& by) {
    key(name);
    camera.rotation_deg += by;
    next_camera(camera);
  };
  turned("Left", {0, 0, 5});
  turned("Right", {0, 0, -5});
  turned("Up", {5, 0, 0});
  turned("Down", {-5, 0, 0});
  for (const char* name : {"plus", "equal", "KP_Add"}) {
    key(name);
    camera.distance *= 0.9;
    next_camera(camera);
  }
  key("minus");
  camera.distance /= 0.9;
  expect_drawn(design_, next_camera(camera));
}

TEST_F(Walking, ShiftedArrowsPan) {
  // Seen from above, so that the picture's right and up are x and y.
  start(kBlock, {"--camera=0,0,0,0,0,0,100"});
  const auto target = [this](const char* name) {
    key(name);
    return camera_of(next()).target;
  };
  // The camera moves against the design.
  Vec3 at = target("shift+Right");
  EXPECT_LT(at.x, -0.1);
  EXPECT_EQ(at.y, 0);
  at = target("shift+Left");
  EXPECT_NEAR(at.x, 0, 1e-9);
  at = target("shift+Up");
  EXPECT_LT(at.y, -0.1);
  at = target("shift+Down");
  EXPECT_NEAR(at.y, 0, 1e-9);
}

TEST_F(Walking, EscapeClosesTheMenus) {
  start();
  const Picture before = shown();
  const auto closes = [&] {
    key("Escape");
    expect_shown(before, {0, 0, kWidth, kHeight});
  };
  for (const char* name : {"F10", "alt"}) {
    SCOPED_TRACE(name);
    press({name});
    closes();
    press({name});
    key(name);
    expect_shown(before, {0, 0, kWidth, kHeight});
  }
  click(15, 8);  // "File"
  display().drive({"mousemove", "--window", window_id(), "399", "150"});
  wait_until_settled(before);
  closes();
}

TEST_F(Walking, MenusAreWalkedThrough) {
  start();
  press({"F10", "Right", "Right", "Up", "Up", "Right", "Down"});  // "Show", "Colours", the second
  key("Return");
  expect_drawn(design_, next(), {"--colorscheme=Metallic"});
  key("Left");  // the arrows are the picture's again
  EXPECT_EQ(camera_of(next()).rotation_deg.z, 30);
}

TEST_F(Walking, ParametersAreSet) {
  start("n = 3; // [1:9]\nshape = 1; // [1, 2, 4]\nfor (i = [1 : n * shape]) cube(i);\n");
  press({"ctrl+p", "Tab", "Down", "Down", "space"});
  key("Right");
  next_of(4);
  key("shift+Right");
  next_of(9);
  key("space");
  press({"Down", "Return", "Down"});
  key("Return");
  next_of(18);
  key("Escape");
  key("Left");
  EXPECT_EQ(camera_of(next()).rotation_deg.z, 30);
}

TEST_F(Walking, AMessageOpensItsPlace) {
  const std::string editor =
      folder_.script("editor", "echo \"$1\" > \"$0.new\"; mv \"$0.new\" \"$0.words\"");
  start("cube(1);\necho(a);\necho(b);\n", {"--editor='" + editor + "' {line}"});
  press({"Tab", "Down", "Down"});  // the tab, and the second message
  key("Return");
  EXPECT_TRUE(wait_until([&] { return folder_.has("editor.words"); }));
  EXPECT_EQ(folder_.read("editor.words"), "3\n");
}

TEST_F(Walking, TheSectionPlaneIsMoved) {
  start();  // 10 wide
  key("x");
  EXPECT_EQ(next()["section_position"], 0);
  key("Prior");
  EXPECT_NEAR(next()["section_position"].get<double>(), 0.2, 1e-9);
  press({"Tab", "Down", "space"});  // its slider
  key("Left");
  EXPECT_LT(next()["section_position"].get<double>(), 0.15);
  key("Escape");
  key("Escape");
  key("Next");
  EXPECT_LT(next()["section_position"].get<double>(), 0);
}

TEST_F(Walking, EnterMeasuresInTheMiddle) {
  start(kBall, {"--camera=0,0,0,0,0,0,100"});
  const Picture before = shown();
  key("Return");
  const json line = next([](const json& any) { return any["points"].size() == 1; });
  EXPECT_NEAR(line["points"][0]["position"][2].get<double>(), kBallRadius, 1e-9);
  wait_until_other(before);
  key("Escape");
  expect_shown(before, {0, 0, kWidth, kHeight});
}

}  // namespace
}  // namespace window_test
