// Tests the mouse in the window: the camera with OpenSCAD's numbers (frontend/OPENSCAD.md,
// "Window"), measuring, the plane.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "designs.hpp"
#include "live_window.hpp"
#include "navigation.hpp"
#include "projection.hpp"

namespace window_test {
namespace {

using csgcore::Vec3;
using testing::ElementsAre;

constexpr double kTurn_degPerPixel = 0.7;
constexpr window::Size kSize{kWidth, kHeight};

class Mouse : public LiveWindow {
 protected:
  /// Starts the window and returns its camera.
  frontend::Camera start(const std::string& text = kBlock, std::vector<std::string> options = {}) {
    design_ = folder_.write("a.csg", text);
    open(design_, options);
    const json line = next();
    return camera_of(line);
  }
  void expect_camera(const frontend::Camera& camera, bool orthographic = false) {
    expect_drawn(design_, next_camera(camera, orthographic));
  }
  csgcore::View view(const frontend::Camera& camera) const {
    return window::Navigation(camera, csgcore::Projection::kPerspective).view(kSize);
  }
  std::string design_;
};

TEST_F(Mouse, LeftDragTurns) {
  frontend::Camera camera = start();
  drag(1, 200, 150, 230, 140);
  camera.rotation_deg -= kTurn_degPerPixel * Vec3(-10, 0, 30);
  expect_camera(camera);
  drag(1, 100, 100, 90, 150, "shift");
  camera.rotation_deg -= kTurn_degPerPixel * Vec3(50, -10, 0);
  expect_camera(camera);
}

/// What is near moves as far on the screen as what the camera looks at: with the mouse.
TEST_F(Mouse, RightDragMovesThePointUnderIt) {
  const frontend::Camera camera = start("cube(size = [30, 30, 30], center = true);\n");
  const Vec3 point(0, -15, 4);  // nearer than the target
  const auto from = *window::project(view(camera), point);
  const int x = static_cast<int>(from.x_px), y = static_cast<int>(from.y_px);
  drag(3, x, y, x + 60, y - 30);
  json line = next([&](const json& any) {
    const auto to = *window::project(view(camera_of(any)), point);
    return std::abs(to.x_px - from.x_px - 60) < 0.1 && std::abs(to.y_px - from.y_px + 30) < 0.1;
  });
  expect_drawn(design_, line);
}

TEST_F(Mouse, RightDragPansAsFarAsOpenScad) {
  frontend::Camera camera = start(kBlock, {"--pan=openscad"});
  drag(3, 200, 150, 240, 135);
  const csgcore::View before = view(camera);
  const double reach = 3 * 0.7 * camera.distance;
  camera.target += reach * (-before.right * (40.0 / kWidth) - before.up * (15.0 / kHeight));
  expect_camera(camera);
}

TEST_F(Mouse, MiddleAndShiftedRightDragMoveForwardAndBack) {
  frontend::Camera camera = start();
  for (const int button : {2, 3}) {
    drag(button, 200, 150, 210, 130, button == 3 ? "shift" : "");
    camera.target -= view(camera).forward * (3 * 0.7 * camera.distance * 20 / kHeight);
    expect_camera(camera);
  }
}

TEST_F(Mouse, WheelZoomsAtTheCursor) {
  for (const char* projection : {"--projection=p", "--projection=o"}) {
    const frontend::Camera camera = start(kBlock, {projection});
    const bool orthographic = std::string(projection).ends_with('o');
    window::Navigation navigation(camera, orthographic ? csgcore::Projection::kOrthographic
                                                       : csgcore::Projection::kPerspective);
    wheel(260, 100, 2);
    navigation.zoom(2, 260, 100, kSize);
    EXPECT_NEAR(navigation.camera().distance, 0.81 * camera.distance, 1e-9);
    expect_camera(navigation.camera(), orthographic);
    wheel(150, 200, -3);
    navigation.zoom(-3, 150, 200, kSize);
    expect_camera(navigation.camera(), orthographic);
  }
}

/// Shows the ball from above, so that the point at each pixel is known.
class MouseOnABall : public Mouse {
 protected:
  MouseOnABall() : camera_{Vec3(0.0), Vec3(0.0), 100} {}
  void open_ball() { start(kBall, {"--camera=0,0,0,0,0,0,100", "--projection=o"}); }

  /// Returns the point of the ball's upper half at a pixel's corner.
  Vec3 surface_at(int x, int y) const {
    const double half_height = 100 * std::tan(11.25 * M_PI / 180);
    const double unit = 2 * half_height / kHeight;
    const double u = unit * (x - 0.5 * kWidth), v = unit * (0.5 * kHeight - y);
    return {u, v, std::sqrt(kBallRadius * kBallRadius - u * u - v * v)};
  }
  json next_points(std::size_t count) {
    return next([count](const json& line) { return line["points"].size() == count; })["points"];
  }
  static void expect_near(const json& place, const Vec3& wanted) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(place[static_cast<std::size_t>(axis)].get<double>(), wanted[axis], 1e-9);
    }
  }
  const frontend::Camera camera_;
};

TEST_F(MouseOnABall, ClicksMeasure) {
  open_ball();
  const Picture before = shown();
  click(210, 140);
  const json one = next_points(1);
  expect_near(one[0]["position"], surface_at(210, 140));
  EXPECT_EQ(one[0]["what"], "sphere(r = 10)");
  EXPECT_EQ(one[0]["file"], "a.csg");
  EXPECT_EQ(one[0]["line"], 1);
  wait_until_other(before);                                     // the place is shown
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // so that it is not a double click
  click(190, 160);
  const json two = next_points(2);
  expect_near(two[0]["position"], surface_at(210, 140));
  expect_near(two[1]["position"], surface_at(190, 160));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  click(20, 240);  // beside the ball, and beside the panel of its place: forgotten
  next_points(0);
  expect_shown(before);
}

/// The mouse names the leaf once it rests, and not before it has moved.
TEST_F(MouseOnABall, RestNamesTheLeaf) {
  open_ball();
  const Picture before = shown();
  display().drive({"mousemove", "--window", window_id(), "210", "140"});
  const json line = next([](const json& any) { return !any["hovered"].is_null(); });
  EXPECT_EQ(line["hovered"]["what"], "sphere(r = 10)");
  wait_until_other(before);
  display().drive({"mousemove", "--window", window_id(), "20", "60"});
  expect_shown(before);
}

/// The panel is drawn before it knows of the mouse, which jumps there and clicks at once.
TEST_F(MouseOnABall, AClickOnAPanelIsThePanels) {
  start(kBall, {"--camera=0,0,0,0,0,0,10"});  // the ball is behind all
  const Picture before = shown();
  key("x");
  next();
  wait_until_settled(before);
  click(kWidth - 20, 40);  // in the title of the section plane's panel
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // no double click
  click(kWidth - 20, 42);
  key("4");
  EXPECT_EQ(next([](const json& line) { return line["section_on"].get<bool>(); })["points"].size(),
            0u);
  click(40, 150);
  next_points(1);
}

TEST_F(MouseOnABall, EscapeForgets) {
  open_ball();
  const Picture before = shown();
  click(210, 140);
  next_points(1);
  wait_until_other(before);
  key("Escape");
  expect_shown(before);
}

TEST_F(MouseOnABall, DoubleClickCentres) {
  open_ball();
  click(230, 120, 2);
  frontend::Camera camera = camera_;
  camera.target = surface_at(230, 120);
  expect_camera(camera, true);
}

/// A click beside a vertex measures just that, and with Alt what is under the mouse.
TEST_F(Mouse, AClickSnapsUnlessAltIsHeld) {
  const frontend::Camera camera = start("cube(size = [10, 20, 30], center = true);\n");
  const Vec3 vertex(5, -10, 15);
  const auto place = window::project(view(camera), vertex);
  const int x = static_cast<int>(place->x_px) - 4, y = static_cast<int>(place->y_px) + 3;
  const auto point = [this](std::size_t count) {
    return next([count](const json& line) { return line["points"].size() == count; })["points"]
        .back();
  };
  click(x, y);
  const json snapped = point(1);
  EXPECT_EQ(snapped["surface"], json({"vertex"}));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(snapped["position"][static_cast<std::size_t>(axis)].get<double>(), vertex[axis],
                1e-12);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // so that it is not a double click
  display().drive({"keydown", "alt", "click", "1", "keyup", "alt"});
  EXPECT_EQ(point(2)["surface"], json({"flat, normal [0, -1, 0]"}));
  const Picture before = shown();
  click(20, 60, 0);
  display().drive({"click", "3"});  // which copies, and says so
  wait_until_other(before);
}

/// A click finds the place in the design, and E opens it.
TEST_F(Mouse, APlaceIsOpenedInTheEditor) {
  const std::string editor = folder_.script(
      "my editor", "for word; do echo \"$word\"; done > \"$0.new\"; mv \"$0.new\" \"$0.words\"");
  design_ = folder_.write("a b.scad", "module ball(r) {\n  sphere(r);\n}\n  ball(10);\n");
  open(design_,
       {"--editor='" + editor + "' -g '{file}:{line}:{column}'", "--camera=0,0,0,0,0,0,100"});
  next_of(1);
  click(200, 150);
  const json points = next([](const json& line) { return line["points"].size() == 1; })["points"];
  EXPECT_EQ(points[0]["what"], "sphere(r = 10)");
  EXPECT_EQ(points[0]["file"], "a b.scad");
  EXPECT_EQ(points[0]["line"], 2);
  EXPECT_EQ(points[0]["column"], 3);
  ASSERT_EQ(points[0]["trail"].size(), 2u);
  EXPECT_EQ(points[0]["trail"][1]["what"], "ball(10)");
  EXPECT_EQ(points[0]["trail"][1]["line"], 4);
  key("e");
  EXPECT_TRUE(wait_until([&] { return folder_.has("my editor.words"); }));
  EXPECT_EQ(folder_.read("my editor.words"),
            "-g\n" + std::filesystem::canonical(design_).string() + ":2:3\n");
  EXPECT_TRUE(wait_until([&] { return children(program().pid()) == 0; })) << "a zombie is left";
}

}  // namespace
}  // namespace window_test
