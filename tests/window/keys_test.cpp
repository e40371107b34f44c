// Tests the keys of the window.
#include <gmock/gmock.h>

#include <cmath>

#include "designs.hpp"
#include "live_window.hpp"

namespace window_test {
namespace {

using csgcore::Vec3;

class Keys : public LiveWindow {
 protected:
  frontend::Camera start(const std::vector<std::string>& options = {}) {
    design_ = folder_.write("a.csg", kBlock);
    open(design_, options);
    first_ = next();
    expect_drawn(design_, first_);
    return camera_of(first_);
  }
  std::string design_;
  json first_;
};

TEST_F(Keys, StandardViews) {
  frontend::Camera camera = start();
  const std::pair<const char*, Vec3> views[] = {{"ctrl+4", {0, 0, 0}},    {"ctrl+5", {180, 0, 0}},
                                                {"ctrl+6", {90, 0, 270}}, {"ctrl+7", {90, 0, 90}},
                                                {"ctrl+8", {90, 0, 0}},   {"ctrl+9", {90, 0, 180}},
                                                {"ctrl+0", {55, 0, 25}}};
  for (const auto& [name, rotation_deg] : views) {
    SCOPED_TRACE(name);
    key(name);
    camera.rotation_deg = rotation_deg;
    expect_drawn(design_, next_camera(camera));
  }
}

TEST_F(Keys, CentreZoomViewAllAndProjection) {
  frontend::Camera camera = start({"--camera=1,2,3,40,50,60,90"});
  key("ctrl+shift+0");
  camera.target = Vec3(0.0);
  next_camera(camera);
  key("ctrl+bracketright");
  camera.distance *= 0.9;
  next_camera(camera);
  key("ctrl+bracketleft");
  camera.distance /= 0.9;
  next_camera(camera);
  key("o");
  expect_drawn(design_, next_camera(camera, true));
  key("p");
  expect_drawn(design_, next_camera(camera, false));
  key("ctrl+shift+v");
  const json whole = next();
  // All of the block is seen, clear of the menu and the status line.
  const Picture picture = drawn(design_, whole["camera"]);
  const Area area = free_area();
  uint32_t left = kWidth, right = 0, top = kHeight, bottom = 0;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      if (picture.at(x, y) == picture.at(0, 0)) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  EXPECT_GT(left, 0u);
  EXPECT_LT(right, kWidth - 1);
  EXPECT_GT(top, 20u);
  EXPECT_LT(bottom, kHeight - 30);
  EXPECT_GT(std::max(double(right - left) / kWidth, double(bottom - top) / area.height), 0.85);
  expect_drawn(design_, whole);
}

TEST_F(Keys, WhatIsShown) {
  start();
  const std::pair<const char*, const char*> shows[] = {{"2", "--show=cells"},
                                                       {"3", "--show=depth"},
                                                       {"4", "--show=normals"},
                                                       {"5", "--show=id"},
                                                       {"1", "--show=surface"}};
  for (const auto& [name, option] : shows) {
    SCOPED_TRACE(option);
    key(name);
    expect_drawn(design_, next(), {option});
  }
  key("ctrl+2");
  expect_drawn(design_, next(), {"--view=axes"});
}

TEST_F(Keys, HelpComesAndGoes) {
  start();
  const Picture before = shown();
  key("F1");
  wait_until_other(before);
  key("F1");
  expect_shown(before, {0, 0, kWidth, kHeight});
}

class Saving : public Keys {
 protected:
  /// Saves to the path that the dialogue proposes, or to another one.
  void save(const std::string& path = "") {
    const Picture before = shown();
    key("ctrl+s");
    wait_until_settled(before);
    if (!path.empty()) display().drive({"key", "ctrl+a", "type", path});
  }
  /// Presses and releases a key at once, before the next frame.
  void enter(const std::string& name) {
    key("Return");
    EXPECT_TRUE(wait_until([&] { return folder_.has(name); }));
  }
};

TEST_F(Saving, WritesThePictureOfTheCommand) {
  start();
  save();
  enter("a.png");
  EXPECT_EQ(read_png(folder_ / "a.png"), drawn(design_, first_["camera"]));
}

TEST_F(Saving, AsksBeforeItOverwrites) {
  folder_.write("a.png", "mine");
  start();
  const Picture closed = shown();
  save();
  const Picture dialogue = shown();
  key("Return");
  wait_until_settled(dialogue);  // it asks
  key("Return");                 // which may have been pressed twice
  key("Escape");
  expect_shown(closed);
  EXPECT_EQ(folder_.read("a.png"), "mine");
  save();
  key("Return");
  wait_until_settled(dialogue);
  key("ctrl+Return");
  EXPECT_TRUE(wait_until([&] { return folder_.read("a.png") != "mine"; }));
  EXPECT_EQ(read_png(folder_ / "a.png"), drawn(design_, first_["camera"]));
}

TEST_F(Saving, DoesNotOverwriteTheDesign) {
  const std::string design = folder_.write("a.png", kBlock);  // the path that it proposes
  open(design);
  next();
  save();
  const Picture before = shown();
  key("Return");
  wait_until_settled(before);
  key("ctrl+Return");
  next();  // it would have been written by then
  EXPECT_EQ(folder_.read("a.png"), kBlock);
}

TEST_F(Saving, WritesMeasurements) {
  start();
  save(folder_ / "b.exr");
  enter("b.exr");
  ProcessSetup setup;
  setup.words = {SCADRAY_PROGRAM,
                 "-o",
                 folder_ / "wanted.exr",
                 "--imgsize=400,300",
                 camera_option(first_["camera"]),
                 design_};
  run(setup);
  EXPECT_TRUE(folder_.read("b.exr") == folder_.read("wanted.exr"));
}

class Exporting : public Saving {
 protected:
  /// Writes what the dialogue proposes, or another path, and waits for the end of it.
  void export_to(const std::string& path = "") {
    const Picture before = shown();
    key("F7");
    wait_until_settled(before);
    if (!path.empty()) display().drive({"key", "ctrl+a", "type", path});
    key("Return");
  }
  std::string written(const std::string& name) {
    EXPECT_TRUE(wait_until([&] { return folder_.has(name); }));
    return folder_.read(name);
  }
  /// Returns what the command writes with these options.
  std::string exported(const std::string& name, std::vector<std::string> options = {}) {
    ProcessSetup setup;
    setup.words = {SCADRAY_PROGRAM, "-o", folder_ / name, design_};
    setup.words.insert(setup.words.end(), options.begin(), options.end());
    run(setup);
    return folder_.read(name);
  }
};

TEST_F(Exporting, WritesTheModelOfTheCommand) {
  design_ = folder_.write("a.scad", "a = 1; // [1:9]\ncube([a, 2, 3]);\n");
  open(design_, {"-D", "a=4"});
  next();
  export_to();
  EXPECT_TRUE(written("a.stl") == exported("wanted.stl", {"-D", "a=4"}));
  export_to(folder_ / "b.off");
  EXPECT_EQ(written("b.off"), exported("wanted.off", {"-D", "a=4"}));
  // The design as it is now, and not without asking.
  const std::string old = folder_.read("a.stl");
  folder_.write("a.scad", "sphere(5);");
  next();
  const Picture closed = shown();
  key("F7");
  wait_until_settled(closed);
  display().drive({"key", "ctrl+a", "type", folder_ / "a.stl"});
  const Picture dialogue = shown();
  key("Return");
  wait_until_settled(dialogue);
  EXPECT_TRUE(folder_.read("a.stl") == old);
  key("ctrl+Return");
  EXPECT_TRUE(wait_until([&] { return folder_.read("a.stl") != old; }));
  EXPECT_TRUE(folder_.read("a.stl") == exported("wanted.stl", {"-D", "a=4"}));
}

TEST_F(Exporting, ProposesADrawingOfAPlaneFigure) {
  design_ = folder_.write("a.scad", "circle(5);\n");
  open(design_);
  next();
  export_to();
  EXPECT_EQ(written("a.svg"), exported("wanted.svg"));
}

TEST_F(Exporting, LeavesTheViewUsableAndIsStopped) {
  // The preview is a cube, and the final render takes for ever.
  design_ = folder_.write(
      "a.scad", "a = [if (!$preview) for (i = [1:1e5], j = [1:1e5]) if (i < 0) 1];\ncube(9);\n");
  open(design_);
  next();
  const Picture before = shown();
  export_to();
  wait_until_other(before);
  key("ctrl+4");
  EXPECT_EQ(next()["camera"]["rotation_deg"], json({0, 0, 0}));
  folder_.write("a.scad", "cube(8);\n");
  next();
  key("Escape");
  export_to(folder_ / "b.stl");  // it would be refused while the other one runs
  EXPECT_TRUE(written("b.stl") == exported("wanted.stl"));
  EXPECT_FALSE(folder_.has("a.stl"));
}

/// The block without the part on one side of a plane across x.
std::string cut_block(double position, bool keeps_lower) {
  const double from = keeps_lower ? position : -100 + position;
  return "difference() {\n" + kBlock + "multmatrix([[1, 0, 0, " + number_text(from) +
         "], [0, 1, 0, -50], [0, 0, 1, -50], [0, 0, 0, 1]]) cube(size = [100, 100, 100]);\n}\n";
}

TEST_F(Keys, SectionPlane) {
  start({"--camera=0,0,0,0,0,0,100", "--projection=o"});  // x to the right, the plane edge-on
  const Picture whole = shown();
  key("x");
  const json cut = next();
  EXPECT_TRUE(cut["section_on"]);
  EXPECT_EQ(cut["section_position"], 0);
  // The area beside the plane's panel.
  const Area area{0, 150, kWidth, 100};
  const auto side = [&](bool keeps_lower) {
    return drawn(folder_.write("cut.csg", cut_block(0, keeps_lower)), cut["camera"]);
  };
  expect_shown(side(true), area);
  key("f");
  next();
  expect_shown(side(false), area);
  key("c");
  EXPECT_FALSE(next()["section_on"]);
  expect_shown(whole);
}

TEST_F(Keys, SectionPlaneUnderTheMouse) {
  start({"--camera=0,0,0,0,0,0,100", "--projection=o"});  // x to the right
  key("x");
  next();
  drag(1, 200, 200, 205, 220, "ctrl");
  const json cut = next();
  const double unit = 2 * 100 * std::tan(11.25 * M_PI / 180) / kHeight;
  EXPECT_NEAR(cut["section_position"].get<double>(), 5 * unit, 1e-9);
  EXPECT_EQ(cut["camera"], first_["camera"]);
  const std::string design =
      folder_.write("cut.csg", cut_block(cut["section_position"].get<double>(), true));
  expect_shown(drawn(design, cut["camera"]), {0, 150, kWidth, 100});
  drag(1, 200, 200, 390, 200, "ctrl");  // no further than the design's end
  EXPECT_NEAR(next()["section_position"].get<double>(), 5, 1e-12);
  drag(1, 200, 200, 250, 200, "ctrl+shift");
  const json turned = next();
  EXPECT_EQ(turned["camera"], first_["camera"]);
  EXPECT_LT(turned["section_normal"][0].get<double>(), 0.95) << "it turns about y";
  EXPECT_NEAR(turned["section_normal"][1].get<double>(), 0, 1e-12);
}

TEST_F(Keys, SectionPlaneAlongAMeasuredFace) {
  start({"--camera=0,0,0,0,0,0,100", "--projection=o"});  // from above
  click(kWidth / 2 + 20, kHeight / 2 + 12);
  next();
  key("shift+f");
  const json cut = next();
  EXPECT_TRUE(cut["section_on"]);
  EXPECT_EQ(cut["section_normal"], json({0, 0, 1}));
}

}  // namespace
}  // namespace window_test
