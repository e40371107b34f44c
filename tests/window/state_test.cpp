// Tests how each command changes the state, and how the menu and the status line show it.
#include "state.hpp"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>

#include "frontend/parser.hpp"
#include "hover_timer.hpp"
#include "projection.hpp"

namespace window {
namespace {

using csgcore::Projection;
using csgcore::Vec3;
using frontend::Shading;
using frontend::Show;
using testing::HasSubstr;

std::shared_ptr<const frontend::ImportedDesign> imported(const std::string& text) {
  return std::make_shared<frontend::ImportedDesign>(
      frontend::import_design(frontend::parse(text, "")));
}

/// A box from (0, 0, 0) to (10, 20, 40).
std::shared_ptr<const frontend::ImportedDesign> block() {
  return imported("cube(size = [10, 20, 40]);");
}

class StateTest : public testing::Test {
 protected:
  StateTest() : state_(frontend::Options{}) { state_.design = block(); }
  State state_;
};

TEST_F(StateTest, StartsAsTheCommandLineSays) {
  frontend::Options options;
  options.camera.camera = frontend::Camera{{1, 2, 3}, {4, 5, 6}, 7};
  options.camera.projection = Projection::kOrthographic;
  options.render.shading = Shading::kPhong;
  options.render.show = Show::kDepth;
  const State state(options);
  EXPECT_EQ(state.navigation.camera().target, Vec3(1, 2, 3));
  EXPECT_EQ(state.navigation.camera().distance, 7);
  EXPECT_TRUE(state.is_checked(Command::kOrthographic));
  EXPECT_TRUE(state.is_checked(Command::kPhongShading));
  EXPECT_TRUE(state.is_checked(Command::kDepth));
}

/// Whoever adds a command has to say here of which kind it is.
TEST_F(StateTest, EveryCommandIsOfOneKind) {
  for (const CommandRow& row : command_rows()) {
    State state(frontend::Options{});
    state.design = block();
    const bool is_applications = row.command == Command::kReload || row.command == Command::kStop ||
                                 row.command == Command::kOpenEditor ||
                                 row.command == Command::kCopy || row.command == Command::kQuit;
    EXPECT_EQ(state.apply(row.command), !is_applications) << row.label;
  }
}

/// In each group exactly the choice that was made last is checked.
TEST_F(StateTest, ChoicesExcludeEachOther) {
  const std::vector<std::vector<Command>> kGroups = {
      {Command::kPerspective, Command::kOrthographic},
      {Command::kSurface, Command::kCells, Command::kDepth, Command::kNormals, Command::kId},
      {Command::kOpenScadShading, Command::kPhongShading, Command::kStudioShading},
      {Command::kSectionX, Command::kSectionY, Command::kSectionZ},
  };
  for (const auto& group : kGroups) {
    for (const Command chosen : group) {
      EXPECT_TRUE(state_.apply(chosen));
      for (const Command other : group) EXPECT_EQ(state_.is_checked(other), other == chosen);
    }
  }
}

/// A linear_extrude in a module, of a circle.
frontend::LeafPlace some_leaf() {
  return {{{"circle(r = 1)", {"/f/a.scad", "a.scad", 1, 2}},
           {"linear_extrude()", {"/f/a.scad", "a.scad", 3, 4}},
           {"post(5)", {"/f/b.scad", "b.scad", 5, 6}}},
          1};
}

TEST_F(StateTest, TheEditorOpensTheChosenPlace) {
  EXPECT_EQ(state_.place_to_open(), nullptr);
  state_.hovered = HoveredLeaf{{}, {{{"cube()", {"/f/c.scad", "c.scad", 7, 8}}}, 0}, false};
  EXPECT_EQ(state_.place_to_open()->line, 7u);
  MeasuredPoint point;
  point.place = some_leaf();
  state_.measure(point);
  EXPECT_EQ(state_.place_to_open()->line, 3u) << "the leaf itself";
  state_.chosen_step = 2;
  EXPECT_EQ(state_.place_to_open()->path, "/f/b.scad");
  state_.measure(point);
  EXPECT_EQ(state_.points.size(), 2u);
  EXPECT_EQ(state_.place_to_open()->line, 3u);
  state_.measure(point);
  EXPECT_EQ(state_.points.size(), 1u);
}

TEST_F(StateTest, AHoveredLeafIsNamedWithItsModule) {
  EXPECT_EQ(hover_text({{}, some_leaf(), false}), "linear_extrude()\na.scad:3:4\nin post(5)");
  EXPECT_EQ(hover_text({{}, {{{"cube()", {"", "", 0, 0}}}, 0}, true}), "cut: cube()");
}

TEST(HoverTimer, IsDueOnceTheMouseRests) {
  using std::chrono::milliseconds;
  const HoverTimer::Clock::time_point start{};
  HoverTimer timer;
  EXPECT_FALSE(timer.due());
  EXPECT_FALSE(timer.take(start + milliseconds(1000))) << "it has not moved";
  timer.move({1, 2}, start);
  timer.move({3, 4}, start + milliseconds(200));
  EXPECT_EQ(timer.due(), start + milliseconds(500));
  EXPECT_FALSE(timer.take(start + milliseconds(499)));
  const auto place = timer.take(start + milliseconds(500));
  ASSERT_TRUE(place);
  EXPECT_EQ(place->y_px, 4);
  EXPECT_FALSE(timer.due()) << "once";
  timer.move({1, 2}, start);
  timer.stop();
  EXPECT_FALSE(timer.due());
}

TEST_F(StateTest, SwitchesAreTurnedOnAndOff) {
  for (const Command command :
       {Command::kAxes, Command::kCrosshairs, Command::kScales, Command::kEdges, Command::kMessages,
        Command::kPlace, Command::kStatus, Command::kHelp, Command::kSection,
        Command::kSectionFlip}) {
    const bool before = state_.is_checked(command);
    EXPECT_TRUE(state_.apply(command));
    EXPECT_NE(state_.is_checked(command), before);
    EXPECT_TRUE(state_.apply(command));
    EXPECT_EQ(state_.is_checked(command), before);
  }
}

TEST_F(StateTest, WhatIsShown) {
  const std::pair<Command, Show> kShows[] = {{Command::kCells, Show::kCells},
                                             {Command::kDepth, Show::kDepth},
                                             {Command::kNormals, Show::kNormals},
                                             {Command::kId, Show::kId},
                                             {Command::kSurface, Show::kSurface}};
  for (const auto& [command, show] : kShows) {
    state_.apply(command);
    EXPECT_EQ(state_.look.show, show);
  }
  state_.apply(Command::kPhongShading);
  EXPECT_EQ(state_.look.shading, Shading::kPhong);
  state_.apply(Command::kOpenScadShading);
  EXPECT_EQ(state_.look.shading, Shading::kOpenScad);
  state_.apply(Command::kPhongShadows);
  EXPECT_EQ(state_.look.phong_shadows, 1);
  state_.apply(Command::kPhongShadows);
  EXPECT_EQ(state_.look.phong_shadows, 0);
  for (const auto order : {frontend::Translucency::kDepth, frontend::Translucency::kFile}) {
    state_.apply(Command::kDepthOrder);
    EXPECT_EQ(state_.look.translucency, order);
  }
  state_.apply(Command::kOrthographic);
  EXPECT_EQ(state_.navigation.projection(), Projection::kOrthographic);
  state_.apply(Command::kPerspective);
  EXPECT_EQ(state_.navigation.projection(), Projection::kPerspective);
}

TEST_F(StateTest, TheCamera) {
  const std::pair<Command, Vec3> kViews[] = {
      {Command::kTop, {0, 0, 0}},       {Command::kBottom, {180, 0, 0}},
      {Command::kLeft, {90, 0, 270}},   {Command::kRight, {90, 0, 90}},
      {Command::kFront, {90, 0, 0}},    {Command::kBack, {90, 0, 180}},
      {Command::kDiagonal, {55, 0, 25}}};
  for (const auto& [command, rotation_deg] : kViews) {
    state_.apply(command);
    EXPECT_EQ(state_.navigation.camera().rotation_deg, rotation_deg);
  }
  const double distance = state_.navigation.camera().distance;
  state_.apply(Command::kZoomIn);
  EXPECT_DOUBLE_EQ(state_.navigation.camera().distance, 0.9 * distance);
  state_.apply(Command::kZoomOut);
  EXPECT_DOUBLE_EQ(state_.navigation.camera().distance, distance);
  state_.apply(Command::kViewAll);
  // The middle of the block is near the middle of the picture, and all of it is seen.
  EXPECT_LE(glm::distance(state_.navigation.camera().target, Vec3(5, 10, 20)), 2);
  for (const Vec3& corner : {Vec3(0), Vec3(10, 20, 40), Vec3(10, 0, 0), Vec3(0, 20, 40)}) {
    const auto place = project(state_.navigation.view({100, 100}), corner);
    ASSERT_TRUE(place);
    EXPECT_LE(std::max(std::abs(place->x_px - 50), std::abs(place->y_px - 50)), 50 + 1e-9);
  }
  state_.apply(Command::kCenter);
  EXPECT_EQ(state_.navigation.camera().target, Vec3(0));
}

/// What is cut away does not count.
TEST_F(StateTest, APlaneStartsAcrossTheMiddleOfWhatIsLeft) {
  state_.design =
      std::make_shared<frontend::ImportedDesign>(frontend::import_design(frontend::parse(
          "difference() { cube(size = [10, 20, 40]); cube(size = [30, 30, 35]); }", "")));
  state_.apply(Command::kSectionZ);
  EXPECT_EQ(state_.section.position, 37.5);
  state_.apply(Command::kViewAll);
  EXPECT_NEAR(state_.navigation.camera().target.z, 36.25, 2);  // the upper half is cut off
}

TEST_F(StateTest, APlaneStartsAcrossTheMiddle) {
  const Command kAcross[] = {Command::kSectionX, Command::kSectionY, Command::kSectionZ};
  for (uint8_t axis = 0; axis < 3; ++axis) {
    state_.apply(kAcross[axis]);
    EXPECT_TRUE(state_.section.is_on);
    EXPECT_EQ(state_.section.axis(), axis);
    EXPECT_EQ(state_.section.position, Vec3(5, 10, 20)[axis]);
  }
  state_.apply(Command::kSection);
  EXPECT_FALSE(state_.section.is_on);
  state_.design = nullptr;
  state_.apply(Command::kSection);
  EXPECT_TRUE(state_.section.is_on);
  EXPECT_EQ(state_.section.axis(), 2);
}

MeasuredPoint at(const Vec3& position, const Surface& surface = {}) {
  MeasuredPoint point;
  point.position = position;
  point.surface = surface;
  return point;
}

TEST_F(StateTest, APlaneIsLaidAlongTheMeasuredFace) {
  state_.apply(Command::kSectionFace);
  EXPECT_FALSE(state_.section.is_on);
  EXPECT_NE(state_.notice, "");
  const Vec3 normal(0.6, 0, 0.8);
  state_.measure(at({1, 2, 3}, {Surface::Kind::kPlane, {1, 2, 3}, normal}));
  state_.apply(Command::kSectionFace);
  EXPECT_TRUE(state_.section.is_on);
  EXPECT_EQ(state_.section.normal, normal);
  EXPECT_NEAR(state_.section.position, glm::dot(normal, Vec3(5, 10, 20)), 1e-12);
}

TEST_F(StateTest, APlaneIsLaidThroughTheLastThreePoints) {
  state_.measure(at({9, 9, 9}));
  state_.measure(at({1, 0, 0}));
  state_.apply(Command::kSectionPoints);
  EXPECT_FALSE(state_.section.is_on) << "there are only two";
  state_.measure(at({0, 1, 0}));
  state_.measure(at({0, 0, 1}));
  state_.apply(Command::kSectionPoints);
  ASSERT_TRUE(state_.section.is_on);
  for (const Vec3& point : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
    EXPECT_NEAR(glm::dot(point, state_.section.normal), state_.section.position, 1e-12);
  }
  state_.section.is_on = false;
  for (const double x : {1.0, 2.0, 3.0}) state_.measure(at({x, x, x}));
  state_.apply(Command::kSectionPoints);
  EXPECT_FALSE(state_.section.is_on) << "they lie on a line";
}

TEST_F(StateTest, APlaneTurnsAboutItsMiddle) {
  state_.apply(Command::kSectionX);
  state_.section.position = 7;
  const Vec3 middle = state_.section_middle();
  EXPECT_EQ(middle, Vec3(7, 10, 20));
  state_.turn_section(20, 50);
  EXPECT_NEAR(glm::length(state_.section.normal), 1, 1e-12);
  EXPECT_LT(std::abs(state_.section.normal.x), 0.95);
  EXPECT_NEAR(glm::dot(middle, state_.section.normal), state_.section.position, 1e-12);
  state_.turn_section(0, 0);
  const Vec3 normal = state_.section.normal;
  state_.turn_section(0, 30);
  EXPECT_NEAR(glm::dot(normal, state_.navigation.view({1, 1}).up),
              glm::dot(state_.section.normal, state_.navigation.view({1, 1}).up), 1e-12);
}

TEST_F(StateTest, EscapeForgetsPointsAndHelp) {
  state_.measure({});
  state_.measure({});
  state_.shows_help = true;
  state_.apply(Command::kForgetPoints);
  EXPECT_TRUE(state_.points.empty());
  EXPECT_FALSE(state_.shows_help);
}

TEST_F(StateTest, SavingAsksForAPath) {
  state_.apply(Command::kSavePicture);
  EXPECT_TRUE(state_.picture_dialogue.is_asked_for);
}

TEST_F(StateTest, ExportingAsksForAPath) {
  state_.name = "/a/b.c.scad";
  state_.apply(Command::kExport);
  EXPECT_TRUE(state_.model_dialogue.is_asked_for);
  EXPECT_EQ(state_.model_dialogue.path, "/a/b.c.stl");
  auto figure = std::make_shared<frontend::ImportedDesign>(*state_.design);
  figure->is_plane_figure = true;
  state_.design = figure;
  state_.apply(Command::kExport);  // the path is the user's from now on
  EXPECT_EQ(state_.model_dialogue.path, "/a/b.c.stl");
  state_.model_dialogue = {};
  state_.apply(Command::kExport);
  EXPECT_EQ(state_.model_dialogue.path, "/a/b.c.svg");
  state_.model_dialogue = {};
  state_.name = "-";
  state_.apply(Command::kExport);
  EXPECT_EQ(state_.model_dialogue.path, "design.svg");
}

TEST_F(StateTest, ExportsProposeNoFileThatIsShown) {
  const auto proposed_for = [&](const std::string& name) {
    state_.name = name;
    state_.model_dialogue = {};
    state_.apply(Command::kExport);
    return state_.model_dialogue.path;
  };
  EXPECT_EQ(proposed_for("/a/part.stl"), "/a/part.3mf");
  EXPECT_EQ(proposed_for("/a/part.3mf"), "/a/part.stl");
  auto figure = std::make_shared<frontend::ImportedDesign>(*state_.design);
  figure->is_plane_figure = true;
  state_.design = figure;
  EXPECT_EQ(proposed_for("/a/part.svg"), "/a/part.dxf");
}

TEST_F(StateTest, OneExportAtATime) {
  state_.name = "a.scad";
  state_.exporting = "a.stl";
  EXPECT_EQ(status_line(state_), "exporting a.stl  |  reading a.scad");
  state_.apply(Command::kExport);
  EXPECT_FALSE(state_.model_dialogue.is_asked_for);
  EXPECT_THAT(state_.notice, testing::HasSubstr("a.stl is being exported"));
  state_.begin({});  // another design; the export goes on
  EXPECT_EQ(state_.exporting, "a.stl");
}

TEST_F(StateTest, StatusLine) {
  state_.name = "a.scad";
  EXPECT_EQ(status_line(state_), "reading a.scad");
  frontend::DesignVersion version;
  version.export_ms = 80;
  version.parse_ms = 1.25;
  version.import_ms = 2;
  state_.version = version;
  EXPECT_EQ(status_line(state_), "1 primitive  |  evaluate 80, parse 1.2, import 2.0");
  Painting painting;
  painting.order.size = {640, 480};
  painting.stats.renderer = "cpu";
  painting.stats.render_ms = 7.5;
  state_.painting = painting;
  state_.frames_per_second = 59.6;
  state_.is_reading = true;
  EXPECT_EQ(status_line(state_),
            "1 primitive  |  evaluate 80, parse 1.2, import 2.0, draw 7.5 ms  |  60 frames/s  |  "
            "cpu  |  640 x 480  |  reading");
  state_.painting->light_ms = 2345.6;
  EXPECT_THAT(status_line(state_), HasSubstr("draw 7.5 ms, light 2346 ms  |  60 frames/s"));
}

TEST_F(StateTest, StatusLineIsShortenedByWhatMattersLeast) {
  const auto shortened = [this](size_t letters) {
    return status_line(state_,
                       [letters](const std::string& line) { return line.size() <= letters; });
  };
  state_.name = "a.scad";
  EXPECT_EQ(shortened(1), "reading a.scad");
  frontend::DesignVersion version;
  version.export_ms = 80;
  version.parse_ms = 1.25;
  version.import_ms = 2;
  state_.version = version;
  Painting painting;
  painting.order.size = {640, 480};
  painting.stats.renderer = "cpu";
  painting.stats.render_ms = 7.5;
  painting.stats.prepare_ms = 1;
  painting.stats.subdivide_ms = 3;
  state_.painting = painting;
  state_.frames_per_second = 59.6;
  state_.is_reading = true;
  EXPECT_EQ(shortened(1000), status_line(state_));
  EXPECT_EQ(shortened(status_line(state_).size()), status_line(state_));
  const std::string shorter =
      "1 primitive  |  evaluate 80, subdivide 3.0, draw 7.5 ms  |  60 frames/s  |  cpu  |  "
      "640 x 480  |  reading";
  EXPECT_EQ(shortened(shorter.size()), shorter);
  EXPECT_EQ(shortened(70), "1 primitive  |  evaluate 80, draw 7.5 ms  |  60 frames/s  |  reading");
  EXPECT_EQ(shortened(1), "1 primitive  |  reading");
  for (size_t letters = 24; letters < 120; ++letters) EXPECT_LE(shortened(letters).size(), letters);
  state_.painting->stats.renderer = "gl: a driver's name";
  EXPECT_EQ(shortened(status_line(state_).size() - 1).find("gl: "), std::string::npos);
  EXPECT_NE(shortened(status_line(state_).size() - 1).find("parse"), std::string::npos);
}

TEST_F(StateTest, AVersionsErrorIsItsFirstMessage) {
  frontend::DesignVersion version;
  version.error = "a.scad:1:1: error: wrong (mend it)";
  version.messages = {"ECHO: 1"};
  state_.is_stopped = true;
  state_.take(version);
  ASSERT_EQ(state_.messages.size(), 2u);
  EXPECT_EQ(state_.messages[0].kind, MessageKind::kError);
  EXPECT_EQ(state_.messages[1].kind, MessageKind::kEcho);
  EXPECT_NE(state_.design, nullptr);  // the last good one stays
  EXPECT_FALSE(state_.is_stopped);
}

TEST_F(StateTest, AnEmptyDesignIsCalledEmpty) {
  frontend::DesignVersion version;
  version.design = imported("");
  state_.take(version);
  EXPECT_THAT(status_line(state_), testing::StartsWith("the design is empty"));
  version.design = imported("cube(1e308);");  // left out
  state_.take(version);
  EXPECT_THAT(status_line(state_), testing::StartsWith("0 primitives"));
}

TEST_F(StateTest, TheStatusLineSaysThatWorkWasStopped) {
  state_.is_stopped = true;
  EXPECT_THAT(status_line(state_), HasSubstr("F5"));
  state_.take({});
  EXPECT_THAT(status_line(state_), testing::Not(HasSubstr("F5")));
  state_.is_stopped = true;
  EXPECT_THAT(status_line(state_), HasSubstr("F5"));
}

}  // namespace
}  // namespace window
