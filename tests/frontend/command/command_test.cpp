// Tests the whole command, with a function in place of the renderer.
#include "frontend/command.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <spng.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <thread>

#include "frontend/error.hpp"
#include "frontend/interrupt.hpp"
#include "frontend/terminal.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

constexpr const char* kSphere = "sphere($fn = 0, $fa = 12, $fs = 2, r = 1);\n";

constexpr const char* kByOpenScad = "--evaluator=openscad";

using Pixel = std::array<uint8_t, 3>;

struct Outcome {
  ExitCode code;
  std::string out;
  std::string err;
};

class Command : public testing::Test {
 protected:
  Command() : file_(folder_.write("a.csg", kSphere)) {}

  /// Plays the renderer: the left half is a surface at distance 5, the right half background.
  Image draw(const csgcore::Scene& scene, const csgcore::View& view, const RenderSettings& settings,
             RenderStats& stats) {
    ++drawings_;
    scene_ = scene;
    view_ = view;
    settings_ = settings;
    stats.renderer = "played";
    stats.technique = technique_;
    stats.reason = reason_;
    stats.measuring_ms = measuring_ms_;
    stats.trace.rays = 7;
    stats.cells = 12;
    stats.draw_calls = 3;
    stats.subdivide_ms = 1.5;
    stats.paper_sr_ms = 4.5;
    Image image;
    image.width_px = view.width_px;
    image.height_px = view.height_px;
    for (uint32_t i = 0; i < view.width_px * view.height_px; ++i) {
      const bool hit = i % view.width_px < view.width_px / 2;
      image.rgb.push_back(hit ? Pixel{200, 100, 50} : Pixel{1, 2, 3});
      if (!settings.measured_channels) continue;
      image.z.push_back(hit ? 5 : std::numeric_limits<float>::infinity());
      image.normal.push_back(hit ? glm::vec3(0, 0, 1) : glm::vec3(0));
      image.position.push_back(glm::vec3(0));
      image.id.push_back(hit ? 0 : csgcore::kNoPrimitive);
    }
    return image;
  }

  /// Where a test plays openscad, that program evaluates the designs.
  Outcome run(std::vector<std::string> arguments) {
    if (std::getenv("OPENSCAD") != nullptr) arguments.insert(arguments.begin(), kByOpenScad);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const ExitCode code = run_command(arguments, renderer_, gl_program_);
    Outcome outcome{code, {}, {}};
    outcome.out = testing::internal::GetCapturedStdout();
    outcome.err = testing::internal::GetCapturedStderr();
    return outcome;
  }

  struct Picture {
    uint32_t width, height;
    std::vector<Pixel> pixels;
  };
  static Picture decode(const std::string& png) {
    spng_ctx* context = spng_ctx_new(0);
    spng_set_png_buffer(context, png.data(), png.size());
    spng_ihdr header{};
    EXPECT_EQ(spng_get_ihdr(context, &header), 0);
    Picture picture{header.width, header.height, {}};
    picture.pixels.resize(std::size_t{header.width} * header.height);
    EXPECT_EQ(spng_decode_image(context, picture.pixels.data(), picture.pixels.size() * 3,
                                SPNG_FMT_RGB8, 0),
              0);
    spng_ctx_free(context);
    return picture;
  }

  TemporaryFolder folder_;
  std::string file_;
  std::string png_ = folder_ / "x.png";
  Renderer renderer_ = [this](const csgcore::Scene& scene, const csgcore::View& view,
                              const RenderSettings& settings,
                              RenderStats& stats) { return draw(scene, view, settings, stats); };
  GlProgramChoice gl_program_;
  std::string technique_ = "tiles";
  std::string reason_;
  double measuring_ms_ = 0;
  int drawings_ = 0;
  csgcore::Scene scene_;
  csgcore::View view_;
  RenderSettings settings_;
};

TEST_F(Command, LeavesPicturesByOpenGlToAnotherProgram) {
  std::vector<RendererKind> asked;
  gl_program_ = [&](const RenderSettings& settings) {
    asked.push_back(settings.renderer);
    return true;
  };
  const Outcome by_gl = run({"-o", png_, "--renderer=gl", file_});
  EXPECT_THAT(by_gl.err, HasSubstr("error: this scadray has no `gl`: "));
  EXPECT_EQ(by_gl.code, ExitCode::kFailure);
  EXPECT_EQ(drawings_, 0);
  // The tests' folder has no scadray-gl, so that this program draws.
  EXPECT_EQ(run({"-o", png_, file_}).code, ExitCode::kDone);
  EXPECT_EQ(drawings_, 1);
  EXPECT_THAT(asked, ElementsAre(RendererKind::kGl, RendererKind::kAuto));
  EXPECT_EQ(run({"-o", folder_ / "x.csg", folder_.write("a.scad", "cube(1);")}).err, "");
  EXPECT_EQ(asked.size(), 2u);  // a text is nothing to draw
}

TEST_F(Command, DrawsAPicture) {
  const Outcome outcome = run({"-o", png_, "--imgsize=4,3", file_});
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.code, ExitCode::kDone);
  const Picture picture = decode(folder_.read("x.png"));
  EXPECT_EQ(picture.width, 4u);
  EXPECT_EQ(picture.height, 3u);
  EXPECT_THAT(
      std::vector(picture.pixels.begin(), picture.pixels.begin() + 4),
      ElementsAre(Pixel{200, 100, 50}, Pixel{200, 100, 50}, Pixel{1, 2, 3}, Pixel{1, 2, 3}));
  ASSERT_EQ(scene_.primitives.size(), 1u);
  EXPECT_FALSE(scene_.model.empty());
  EXPECT_FALSE(settings_.measured_channels);
  EXPECT_FALSE(settings_.all_stats);
}

TEST_F(Command, HandsItsOptionsToTheRenderer) {
  run({"-o", png_, "--imgsize=4,3", "--shading=phong", "--show=cells", "--leaf-primitives=2",
       "--threshold=1", "--threads=2", "--samples=9", "--renderer=cpu", "--colorscheme=Nature",
       "--projection=o", "--camera=1,2,3,90,0,0,10", file_});
  EXPECT_EQ(settings_.shading, Shading::kPhong);
  EXPECT_EQ(settings_.show, Show::kCells);
  EXPECT_EQ(settings_.leaf_primitives, 2u);
  EXPECT_EQ(settings_.threshold_px, 1);
  EXPECT_EQ(settings_.threads, 2u);
  EXPECT_EQ(settings_.samples, 9u);
  EXPECT_EQ(settings_.renderer, RendererKind::kCpu);
  EXPECT_EQ(settings_.technique, Technique::kCells);
  EXPECT_STREQ(settings_.scheme.name, "Nature");
  EXPECT_EQ(view_.projection, csgcore::Projection::kOrthographic);
  EXPECT_EQ(view_.eye, csgcore::Vec3(1, -8, 3));
  EXPECT_EQ(view_.width_px, 4u);
}

TEST_F(Command, FacetsAreAsAsked) {
  const std::string nut = folder_.write("nut.csg", "cylinder($fn = 6, r = 1, h = 1);\n");
  EXPECT_EQ(run({"-o", png_, nut}).err, "");
  EXPECT_EQ(scene_.primitives.at(0).shape(), csgcore::Shape::kPolyhedron);
  EXPECT_EQ(run({"-o", png_, "--facets=none", nut}).err, "");
  EXPECT_EQ(scene_.primitives.at(0).shape(), csgcore::Shape::kFrustum);
}

TEST_F(Command, WithoutACameraTheDesignFillsThePicture) {
  const std::string round = folder_.write("round.csg", "sphere($fn = 200, r = 1);\n");
  run({"-o", png_, round});
  const double half_fov = 11.25 * std::numbers::pi / 180;
  // The facets' box is smaller than the ball's by at most 1 - cos(180°/200), 0.02%.
  EXPECT_NEAR(std::sqrt(glm::dot(view_.eye, view_.eye)), std::sqrt(3.0) / std::sin(half_fov),
              1e-3 * std::sqrt(3.0) / std::sin(half_fov));
}

TEST_F(Command, SeveralOutputsAreDrawnOnce) {
  const Outcome outcome =
      run({"-o", png_, "-o", folder_ / "y.exr", "-o", folder_ / "z.png", file_});
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(drawings_, 1);
  EXPECT_TRUE(settings_.measured_channels);
  EXPECT_THAT(folder_.read("y.exr"), StartsWith("\x76\x2f\x31\x01"));
  EXPECT_EQ(folder_.read("x.png"), folder_.read("z.png"));
  EXPECT_THAT(folder_.names(), ElementsAre("a.csg", "x.png", "y.exr", "z.png"));
}

TEST_F(Command, StandardOutput) {
  const Outcome outcome = run({"-o", "-", "--export-format=png", "--imgsize=4,3", file_});
  EXPECT_EQ(decode(outcome.out).width, 4u);
  EXPECT_EQ(run({"-o", "/dev/stdout", "--export-format=png", "--imgsize=4,3", file_}).out,
            outcome.out);
}

TEST_F(Command, ChannelsAreShown) {
  const auto first_pixel = [this](const std::string& show) {
    run({"-o", png_, "--imgsize=4,3", "--show=" + show, file_});
    const Picture picture = decode(folder_.read("x.png"));
    EXPECT_EQ(picture.pixels[3], (Pixel{0xff, 0xff, 0xe5})) << show;  // the scheme's background
    return picture.pixels[0];
  };
  EXPECT_EQ(first_pixel("depth"), (Pixel{255, 255, 255}));
  EXPECT_EQ(first_pixel("normals"), (Pixel{128, 128, 255}));
  EXPECT_NE(first_pixel("id"), (Pixel{200, 100, 50}));
}

TEST_F(Command, AxesAreDrawn) {
  run({"-o", png_, "--imgsize=64,64", "--view=axes", "--camera=0,0,0,0,0,0,4", file_});
  EXPECT_TRUE(settings_.measured_channels);
  const Picture picture = decode(folder_.read("x.png"));
  EXPECT_EQ(picture.pixels[32 * 64 + 60], (Pixel{0, 0, 0}));  // +x, in front of the background
  const Pixel red{255, 0, 0};
  EXPECT_NE(std::find(picture.pixels.begin(), picture.pixels.end(), red), picture.pixels.end());
}

TEST_F(Command, TheFinalRenderIsViewedAsTheOperationsLeaveIt) {
  const std::string cut =
      folder_.write("cut.csg",
                    "difference() { cube(size = 10); multmatrix([[1,0,0,4],[0,1,0,-1],[0,0,1,-1]]) "
                    "{ cube(size = 20); } }\n");
  EXPECT_EQ(run({"-o", png_, cut}).err, "");
  const double operands = std::sqrt(glm::dot(view_.eye, view_.eye));
  EXPECT_EQ(run({"-o", png_, "--render=1", cut}).err, "");
  EXPECT_LT(std::sqrt(glm::dot(view_.eye, view_.eye)), 0.9 * operands);
  EXPECT_EQ(drawings_, 2);
}

TEST_F(Command, AnEmptyDesignIsBackgroundWithoutARenderer) {
  for (const char* text : {"\n", "", "group();\n", "sphere(r = 0);\n"}) {
    const std::string empty = folder_.write("empty.csg", text);
    const Outcome outcome = run({"-o", png_, "-o", folder_ / "x.exr", "--imgsize=2,2",
                                 "--colorscheme=Starnight", "--info", empty});
    EXPECT_EQ(outcome.code, ExitCode::kDone) << text;
    EXPECT_THAT(decode(folder_.read("x.png")).pixels, testing::Each(Pixel{0, 0, 0}));
    EXPECT_THAT(outcome.err, HasSubstr("renderer: none"));
  }
  EXPECT_EQ(drawings_, 0);
}

TEST_F(Command, AnEmptyDesignMayBeAGradient) {
  const std::string empty = folder_.write("empty.csg", "");
  run({"-o", png_, "--imgsize=1,4", "--colorscheme=ClearSky", empty});
  EXPECT_THAT(decode(folder_.read("x.png")).pixels,
              ElementsAre(Pixel{143, 209, 236}, Pixel{160, 216, 239}, Pixel{176, 223, 242},
                          Pixel{193, 230, 245}));
}

TEST_F(Command, ACameraThatSeesNothingIsBackgroundWithoutARenderer) {
  for (const char* camera :
       {"--camera=0,0,0,0,0,0,0", "--camera=0,0,0,0,0,0,-5", "--camera=1,2,3,1,2,3"}) {
    const Outcome outcome = run({"-o", png_, "-o", folder_ / "x.exr", "--imgsize=2,2",
                                 "--colorscheme=Starnight", "--info", camera, file_});
    EXPECT_EQ(outcome.code, ExitCode::kDone) << camera;
    EXPECT_THAT(decode(folder_.read("x.png")).pixels, testing::Each(Pixel{0, 0, 0}));
    EXPECT_THAT(outcome.err, HasSubstr("renderer: none"));
  }
  EXPECT_EQ(drawings_, 0);
  EXPECT_EQ(run({"-o", png_, "--camera=0,0,0,0,0,0,-5", "--projection=o", file_}).err, "");
  EXPECT_EQ(drawings_, 1);
}

/// In OpenSCAD, too, every picture has the axes in the corner.
TEST_F(Command, WhereNothingIsSeenOfTheAxesTheirCornerStandsAlone) {
  const auto picture = [&](const std::string& camera, const char* view) {
    run({"-o", png_, "--imgsize=64,64", camera, view, file_});
    return decode(folder_.read("x.png")).pixels;
  };
  const auto blind = picture("--camera=0,0,0,55,0,25,0", "--view=axes,scales,crosshairs,edges");
  EXPECT_EQ(blind, picture("--camera=0,0,0,55,0,25,-9", "--view=axes"));
  const Pixel background = blind.front();
  const auto drawn =
      blind.size() - static_cast<size_t>(std::count(blind.begin(), blind.end(), background));
  EXPECT_GT(drawn, 10u);
  EXPECT_LT(drawn, 200u);
}

TEST_F(Command, Statistics) {
  const Outcome outcome = run({"-o", png_, "--imgsize=4,3", "--stats=-", file_});
  EXPECT_TRUE(settings_.all_stats);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["file"], file_);
  EXPECT_EQ(json["file_bytes"], std::string(kSphere).size());
  EXPECT_EQ(json["nodes"], 1);
  EXPECT_EQ(json["primitive_nodes"], 1);
  EXPECT_EQ(json["width_px"], 4);
  EXPECT_EQ(json["height_px"], 3);
  EXPECT_EQ(json["renderer"], "played");
  EXPECT_EQ(json["technique"], "tiles");
  EXPECT_EQ(json["cells"], 12);
  EXPECT_EQ(json["draw_calls"], 3);
  EXPECT_EQ(json["rays"], 7);
  EXPECT_EQ(json["times_ms"]["subdivide"], 1.5);
  EXPECT_EQ(json["paper_ms"]["S"], 1.5);
  EXPECT_EQ(json["paper_ms"]["S_R"], 4.5);
  EXPECT_GT(json["times_ms"]["parse"], 0);
  EXPECT_GT(json["times_ms"]["encode"], 0);
  EXPECT_GT(json["times_ms"]["total"], 0);
  EXPECT_EQ(json["times_ms"]["export"], 0);
  run({"-o", png_, "--stats", folder_ / "s.json", file_});
  EXPECT_EQ(nlohmann::json::parse(folder_.read("s.json"))["cells"], 12);
}

TEST_F(Command, TheTotalIsWithoutDrawingsThatOnlyMeasure) {
  measuring_ms_ = 1e6;
  const auto json = nlohmann::json::parse(run({"-o", png_, "--stats=-", file_}).out);
  EXPECT_LT(json["times_ms"]["total"], 0);
}

TEST_F(Command, StatisticsHaveExactlyTheKeysOfTheReadme) {
  const auto json =
      nlohmann::json::parse(run({"-o", png_, "--stats=-", "--imgsize=1,1", file_}).out);
  const auto keys = [](const nlohmann::json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
  };
  EXPECT_THAT(keys(json),
              ElementsAre("cells", "cells_drawn", "design_leaves", "draw_calls", "edge_pixels",
                          "file", "file_bytes", "height_px", "intersections", "layers",
                          "leaf_primitives", "leaves", "nodes", "paper_ms", "primitive_nodes",
                          "primitives", "rays", "renderer", "resolved_rays", "subdivision_bytes",
                          "technique", "tiles", "times_ms", "width_px"));
  EXPECT_THAT(keys(json["leaves"]), ElementsAre("dropped", "empty", "full", "general", "given_up",
                                                "pair", "total", "union"));
  EXPECT_THAT(keys(json["times_ms"]),
              ElementsAre("context", "cull", "encode", "export", "import", "parse", "prepare",
                          "read", "render", "subdivide", "total", "trace", "traverse"));
  EXPECT_THAT(keys(json["design_leaves"]),
              ElementsAre("compound", "exact", "faceted", "left_out", "total"));
  EXPECT_THAT(keys(json["paper_ms"]), ElementsAre("S", "S_R", "T_R", "T_S"));
}

TEST_F(Command, HelpVersionInfo) {
  Outcome outcome = run({"--help"});
  EXPECT_EQ(outcome.code, ExitCode::kDone);
  EXPECT_THAT(outcome.out, HasSubstr("--imgsize"));
  outcome = run({"-v"});
  EXPECT_EQ(outcome.code, ExitCode::kDone);
  EXPECT_THAT(outcome.out,
              testing::MatchesRegex(
                  "scadray version [0-9.]+\nlanguages of OpenSCAD: 2026 .default., 2021.01\n"));
  outcome = run({"--info"});
  EXPECT_EQ(outcome.code, ExitCode::kDone);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("OpenEXR"), HasSubstr("renderers: cpu")));
  EXPECT_EQ(run({"--info", "-o", png_, file_}).err, "renderer: played\n");
  reason_ = "no GPU";
  EXPECT_EQ(run({"--info", "-o", png_, file_}).err, "renderer: played (no GPU)\n");
}

TEST_F(Command, SaysWhereTilesWereNotTaken) {
  EXPECT_EQ(run({"--technique=tiles", "-o", png_, file_}).err, "");
  technique_ = "cells";
  EXPECT_THAT(run({"--technique=tiles", "-o", png_, file_}).err, HasSubstr("drawn cells"));
  EXPECT_EQ(run({"--technique=cells", "-o", png_, file_}).err, "");
}

TEST_F(Command, EchoesGoToStandardOutputOnDemand) {
  const std::string design = folder_.write("a.scad", "echo(\"said\"); cube(nope);");
  const Outcome apart = run({"--echo", "-o", png_, design});
  EXPECT_EQ(apart.out, "ECHO: \"said\"\n");
  EXPECT_THAT(apart.err, AllOf(HasSubstr("nope"), Not(HasSubstr("said"))));
  EXPECT_EQ(run({"--echo", "-q", "-o", png_, design}).out, apart.out);
  EXPECT_THAT(run({"-o", png_, design}).err, HasSubstr("ECHO: \"said\""));
}

TEST_F(Command, QuietShowsErrorsOnly) {
  const std::vector<std::string> loud = {"-o", png_, "--csglimit=9", "--view=scales", file_};
  EXPECT_THAT(run(loud).err, AllOf(HasSubstr("--csglimit"), HasSubstr("scales")));
  std::vector<std::string> quiet = loud;
  quiet.push_back("-q");
  EXPECT_EQ(run(quiet).err, "");
  EXPECT_THAT(run({"-q", "-o", png_, folder_ / "none.csg"}).err, HasSubstr("none.csg: error: "));
}

/// Each line runs with an existing x.png, which it must not change.
TEST_F(Command, FailuresExitWith1AndTouchNothing) {
  folder_.write("x.png", "before");
  folder_.write("x00001.png", kSphere);
  folder_.write("bad.csg", "sphere(r = 1);\ncube(;\n");
  const auto names = folder_.names();
  const auto expect_failure = [&](const std::vector<std::string>& arguments,
                                  const std::string& text) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, ExitCode::kFailure) << text;
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_THAT(outcome.err, HasSubstr("error: "));
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(folder_.names(), names);
    EXPECT_EQ(folder_.read("x.png"), "before");
  };
  expect_failure({}, "error: no file to draw (");
  expect_failure({file_}, "error: this scadray has no `window`: ");
  expect_failure({"-o", png_, "--bogus", file_}, "--bogus");
  expect_failure({"-o", png_, folder_ / "none.csg"}, "none.csg: error: ");
  expect_failure({"-o", png_, folder_ / "none.scad"}, "none.scad: error: ");
  expect_failure({"-o", png_, folder_.path()}, "is a folder");
  expect_failure({"-o", png_, "validate"}, "validate: error: ");
  expect_failure({"-o", png_, folder_ / "bad.csg"}, "bad.csg:2:");
  expect_failure({"-o", png_, "-o", folder_ / "none/y.png", file_}, "none/y.png: error: ");
  expect_failure({"-o", png_, "--stats", folder_ / "none/s.json", file_}, "none/s.json");
  expect_failure({"-o", png_, "-d", folder_ / "none/x.d", file_}, "none/x.d");
  expect_failure({"-o", png_, "-d", "-", "--stats=-", file_}, "standard output");
  expect_failure({"-o", png_, "/dev/zero"}, "/dev/zero: error: is no design (give ");
  expect_failure({"-o", png_, "-o", png_, file_}, "x.png: error: -o would overwrite -o (");
  expect_failure({"-o", png_, "--stats", png_, file_}, "--stats would overwrite -o (");
  expect_failure({"-o", png_, "-d", folder_ / "./x.png", file_},
                 "-d would overwrite -o, which is " + png_);
  expect_failure({"-o", png_, "--stats", folder_ / "y", "-d", folder_ / "y", file_},
                 "-d would overwrite --stats (");
  expect_failure({"-o", png_, "--stats", file_, file_}, "--stats would overwrite the design (");
  expect_failure({"-o", png_, "-p", folder_ / "bad.csg", "-d", folder_ / "bad.csg", file_},
                 "-d would overwrite what -p reads (");
  expect_failure({"-o", folder_ / "x.png", "--animate=2", folder_ / "x00001.png"},
                 "-o would overwrite the design (");
  expect_failure({"-o", folder_ / "x\n.png", "-d", folder_ / "x.d", file_},
                 "error: no rule for make can name ");
  EXPECT_EQ(drawings_, 0) << "what can be seen beforehand is";
  renderer_ = [](const auto&, const auto&, const auto&, auto&) -> Image {
    throw Error("", {}, "no OpenGL", "install a driver");
  };
  expect_failure({"-o", png_, "-o", folder_ / "y.exr", file_},
                 "error: no OpenGL (install a driver)");
  renderer_ = [](const auto&, const auto&, const auto&, auto&) -> Image { throw std::bad_alloc(); };
  expect_failure({"-o", png_, file_}, "out of memory");
  renderer_ = [](const auto&, const auto&, const auto&, auto&) -> Image {
    throw std::runtime_error("something else");
  };
  expect_failure({"-o", png_, file_}, "something else");
}

TEST_F(Command, WhatCannotBeDrawnIsLeftOut) {
  const std::string warning =
      "mixed.csg:2:2: warning: cube is left out (it is too large, or too far from the origin: "
      "scale the design to between 1e-90 and 1e90 across)\n";
  const std::string mixed = folder_.write("mixed.csg", "sphere(r = 1);\n cube(1e308);\n");
  // The option used to be needed for this; scripts may still give it.
  for (const char* option : {"--imgsize=64,64", "--skip-unsupported"}) {
    drawings_ = 0;
    const Outcome outcome = run({"-o", png_, option, mixed});
    EXPECT_EQ(outcome.code, ExitCode::kDone);
    EXPECT_EQ(outcome.err, folder_.path() + "/" + warning);
    EXPECT_EQ(drawings_, 1);
    EXPECT_EQ(run({"-q", "-o", png_, option, mixed}).err, "");
  }
  // If the design has nothing else, the picture shows the background.
  std::filesystem::remove(png_);
  drawings_ = 0;
  const std::string flat = folder_.write("flat.csg", "cylinder(1e308); cube(1e308);");
  const Outcome outcome = run({"-o", png_, flat});
  EXPECT_EQ(outcome.code, ExitCode::kDone);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("flat.csg:1:1: warning: cylinder is left out"),
                                 HasSubstr("flat.csg:1:18: warning: cube is left out")));
  EXPECT_TRUE(std::filesystem::exists(png_));
  EXPECT_EQ(drawings_, 0);
}

TEST_F(Command, HardWarningsAreErrors) {
  const std::string mixed = folder_.write("mixed.csg", "sphere(r = 1);\n cube(1e308);\n");
  for (const char* quiet : {"--quiet", "--info"}) {
    const Outcome outcome = run({"-o", png_, "--hardwarnings", quiet, mixed});
    EXPECT_EQ(outcome.code, ExitCode::kFailure);
    EXPECT_THAT(outcome.err, HasSubstr("mixed.csg:2:2: error: cube is left out (it is too large"));
    EXPECT_FALSE(std::filesystem::exists(png_));
    EXPECT_EQ(drawings_, 0);
  }
  const Outcome outcome = run({"-o", png_, "--hardwarnings", file_});
  EXPECT_EQ(outcome.code, ExitCode::kDone);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Command, ReadsStandardInput) {
  const int saved = dup(STDIN_FILENO);
  const int input = open(file_.c_str(), O_RDONLY);
  dup2(input, STDIN_FILENO);
  close(input);
  const Outcome outcome = run({"-o", png_, "--stats=-", "-"});
  dup2(saved, STDIN_FILENO);
  close(saved);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["primitive_nodes"], 1);
}

TEST_F(Command, ExportsAScad) {
  const Environment openscad(
      "OPENSCAD",
      folder_.script("openscad", "echo \"$@\" >" + (folder_ / "arguments") +
                                     "; echo 'WARNING: careful' >&2; echo 'sphere(r = 1);'"));
  const std::string scad = folder_.write("a.SCAD", "sphere(1);");
  const Outcome outcome = run({"-o", png_, "-D", "x=1", "--stats=-", scad});
  EXPECT_EQ(outcome.code, ExitCode::kDone);
  EXPECT_EQ(outcome.err, "WARNING: careful\n");
  EXPECT_THAT(folder_.read("arguments"),
              MatchesRegex("-o - --export-format=csg -d [^ ]+ -D x=1 -- " + scad + "\n"));
  EXPECT_GT(nlohmann::json::parse(outcome.out)["times_ms"]["export"], 0);
  EXPECT_EQ(run({"-q", "-o", png_, scad}).err, "");
}

TEST_F(Command, AFileOfAnotherNameMayBeEither) {
  const Environment openscad("OPENSCAD", folder_.script("openscad", "echo 'sphere(r = 1);'"));
  const std::string scad = folder_.write("scad-x7Qf", "module ball() sphere(1); ball();");
  const Outcome exported = run({"-o", png_, "--stats=-", scad});
  EXPECT_EQ(exported.code, ExitCode::kDone) << exported.err;
  EXPECT_GT(nlohmann::json::parse(exported.out)["times_ms"]["export"], 0);
  const Outcome parsed = run({"-o", png_, "--stats=-", folder_.write("a.txt", "sphere(r = 1);")});
  EXPECT_EQ(nlohmann::json::parse(parsed.out)["times_ms"]["export"], 0);
  // A file of this name is a .csg, and what is not a regular file can be read only once.
  const std::string csg = folder_.write("a.CSG", "module ball() sphere(1);");
  EXPECT_THAT(run({"-o", png_, csg}).err, HasSubstr("a.CSG:1:1: error: "));
  EXPECT_THAT(run({"-o", png_, "/dev/null"}).err, IsEmpty());
}

TEST_F(Command, ARuleForMake) {
  const std::string rule = folder_ / "x.d";
  EXPECT_EQ(run({"-o", png_, "-d", rule, file_}).code, ExitCode::kDone);
  EXPECT_EQ(folder_.read("x.d"), png_ + ": \\\n\t" + file_ + "\n");
  const Environment openscad(
      "OPENSCAD",
      folder_.script("openscad",
                     "while [ \"$1\" != -d ]; do shift; done\n"
                     "printf '<stdout>: \\\\\n\t/lib/b\\ c.scad \\\\\n\t$#.scad\n' >$2\n"
                     "echo 'sphere(r = 1);'"));
  const std::string scad = folder_.write("a.scad", "sphere(1);");
  EXPECT_EQ(run({"-o", png_, "-o", folder_ / "x y.exr", "-d", rule, scad}).err, "");
  EXPECT_EQ(folder_.read("x.d"),
            png_ + " " + folder_ / "x\\ y.exr" + ": \\\n\t/lib/b\\ c.scad \\\n\t$$\\#.scad\n");
  EXPECT_EQ(run({"-o", "-", "--export-format=png", "-d", rule, scad}).code, ExitCode::kDone);
  EXPECT_THAT(folder_.read("x.d"), StartsWith("<stdout>: "));
  EXPECT_EQ(run({"-o", png_, "-d", "-", file_}).out, png_ + ": \\\n\t" + file_ + "\n");
}

TEST_F(Command, ARuleForMakeNamesImportedFiles) {
  folder_.write("b.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const std::string csg = folder_.write("i.csg", "import(\"b.off\"); import(\"gone.stl\");");
  const Outcome outcome = run({"-o", png_, "-d", folder_ / "x.d", csg});
  EXPECT_EQ(outcome.code, ExitCode::kDone);
  EXPECT_THAT(outcome.err, HasSubstr("i.csg:1:18: warning: import: Can't open import file '" +
                                     folder_ / "gone.stl" + "'"));
  EXPECT_EQ(folder_.read("x.d"), png_ + ": \\\n\t" + folder_ / "b.off" + " \\\n\t" +
                                     folder_ / "gone.stl" + " \\\n\t" + csg + "\n");
  // openscad has named one of them.
  const Environment openscad(
      "OPENSCAD", folder_.script("openscad",
                                 "while [ \"$1\" != -d ]; do shift; done\n"
                                 "printf 'x: \\\\\n\t" +
                                     folder_ / "b.off" + " \\\\\n\ta.scad\n' >$2\ncat " + csg));
  run({"-o", png_, "-d", folder_ / "x.d", folder_.write("a.scad", "import(\"b.off\");")});
  EXPECT_EQ(folder_.read("x.d"), png_ + ": \\\n\t" + folder_ / "b.off" + " \\\n\t" +
                                     folder_ / "gone.stl" + " \\\n\ta.scad\n");
  EXPECT_THAT(run({"-o", png_, "--stats", folder_ / "b.off", csg}).err,
              HasSubstr("--stats would overwrite a file of the design"));
}

TEST_F(Command, WhatTheDesignReadsIsNotOverwrittenEither) {
  const std::string used = folder_.write("used.scad", "module used() sphere(1);");
  const Environment openscad("OPENSCAD",
                             folder_.script("openscad",
                                            "while [ \"$1\" != -d ]; do shift; done\n"
                                            "printf 'x: \\\\\n\t" +
                                                used + "\n' >$2\necho 'sphere(r = 1);'"));
  const std::string scad = folder_.write("a.scad", "use <used.scad>\nused();");
  const auto names = folder_.names();
  const Outcome outcome = run({"-o", png_, "-d", folder_ / "x.d", "--stats", used, scad});
  EXPECT_EQ(outcome.code, ExitCode::kFailure);
  EXPECT_EQ(outcome.err, used +
                             ": error: --stats would overwrite a file of the design (give "
                             "--stats a file of its own)\n");
  EXPECT_EQ(folder_.names(), names);
  EXPECT_EQ(folder_.read("used.scad"), "module used() sphere(1);");
}

TEST_F(Command, DevicesMayRepeat) {
  const Outcome outcome = run({"-o", "/dev/null", "-o", "/dev/null", "--export-format=png",
                               "--stats=/dev/null", "-d", "/dev/null", file_});
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.code, ExitCode::kDone);
}

TEST_F(Command, AnEndlessExportIsRefused) {
  const std::string scad = folder_.write("a.scad", "sphere(1);");
  const Environment openscad("OPENSCAD", folder_.script("openscad", "yes"));
  EXPECT_THAT(run({"-o", png_, scad}).err,
              StartsWith(scad + " (its .csg):1:1: error: unknown node 'y'"));
  EXPECT_FALSE(folder_.has("x.png"));
}

/// Plays an openscad that tells its $t, and draws a ball of that size.
constexpr const char* kAnimated =
    "while [ \"$1\" != -- ]; do case \"$1\" in '$t='*) t=${1#*=};; -d) d=$2;; esac; shift; done\n"
    "echo \"ECHO: $t\" >&2; [ -z \"$d\" ] || printf 'x: \\\\\n\t%s\n\t%s\n' $t.stl \"$2\" >\"$d\"\n"
    "if [ $t = $BROKEN_AT ]; then exit 1; fi; echo \"sphere(r = 1$t);\"";

TEST_F(Command, AnAnimation) {
  const Environment openscad("OPENSCAD", folder_.script("openscad", kAnimated));
  const Environment not_broken("BROKEN_AT", "never");
  const std::string scad = folder_.write("a.scad", "sphere(1 + $t);");
  const Outcome outcome = run({"-o", folder_ / "x.y.png", "-o", folder_ / "z.exr", "--animate", "3",
                               "-d", folder_ / "x.d", "--stats", folder_ / "s.json", scad});
  EXPECT_EQ(outcome.err, "ECHO: 0\nECHO: 0.3333333333333333\nECHO: 0.6666666666666666\n");
  EXPECT_EQ(outcome.code, ExitCode::kDone);
  EXPECT_EQ(drawings_, 3);
  EXPECT_EQ(scene_.primitives[0].as<csgcore::SphereShape>().radius, 10.6666666666666666);
  std::string targets;
  for (const char* number : {"00000", "00001", "00002"}) {
    const std::string png = std::string("x.y") + number + ".png",
                      exr = "z" + std::string(number) + ".exr";
    EXPECT_EQ(decode(folder_.read(png)).width, 512u);
    EXPECT_TRUE(folder_.has(exr));
    targets += (targets.empty() ? "" : " ") + folder_ / png + " " + folder_ / exr;
  }
  EXPECT_FALSE(folder_.has("x.y.png"));
  EXPECT_EQ(folder_.read("x.d"),
            targets + ": \\\n\t0.stl \\\n\t" + scad +
                " \\\n\t0.3333333333333333.stl \\\n\t0.6666666666666666.stl\n");
  EXPECT_GT(nlohmann::json::parse(folder_.read("s.json"))["times_ms"]["export"], 0);
}

TEST_F(Command, AnAnimationsTimeIsKnownToTheDesignsOwnVariables) {
  const std::string scad = folder_.write("a.scad", "r = 1 + $t; sphere(r);");
  EXPECT_EQ(run({"-o", png_, "--evaluator=own", "--animate=4", scad}).err, "");
  EXPECT_EQ(scene_.primitives[0].as<csgcore::SphereShape>().radius, 1.75);
}

TEST_F(Command, AnAnimationOfACsgShowsTheSameAgainAndAgain) {
  EXPECT_EQ(run({"-o", png_, "--animate=2", file_}).err, "");
  EXPECT_EQ(folder_.read("x00000.png"), folder_.read("x00001.png"));
}

TEST_F(Command, ATurntableGoesOnceAround) {
  EXPECT_EQ(run({"-o", png_, "--camera=1,2,3,55,0,270,100", file_}).err, "");
  const csgcore::View wanted = view_;
  EXPECT_EQ(run({"-o", png_, "--animate=4", "--turn", "--camera=1,2,3,55,0,0,100", file_}).err, "");
  EXPECT_EQ(drawings_, 5);
  EXPECT_EQ(view_, wanted);
  EXPECT_THAT(run({"-o", png_, "--turn", file_}).err, HasSubstr("--turn without --animate"));
}

TEST_F(Command, AnAnimationInOneFileHasAllFrames) {
  EXPECT_EQ(run({"-o", folder_ / "x.gif", "--animate=3", "--turn", file_}).err, "");
  EXPECT_EQ(drawings_, 3);
  const std::string first = folder_.read("x.gif");
  EXPECT_FALSE(folder_.has("x00000.gif"));
  EXPECT_EQ(run({"-o", folder_ / "x.gif", "--animate=3", "--turn", "--fps=7", file_}).err, "");
  EXPECT_NE(folder_.read("x.gif"), first) << "it has other times";
  EXPECT_EQ(run({"-o", folder_ / "x.gif", file_}).err, "") << "a still";
  EXPECT_LT(folder_.read("x.gif").size(), first.size());
  // Beside files for each frame, and as targets for make.
  EXPECT_EQ(run({"-o", png_, "-o", folder_ / "y.gif", "-o", folder_ / "y.webp", "--animate=2", "-d",
                 folder_ / "y.d", file_})
                .err,
            "");
  EXPECT_TRUE(folder_.has("x00000.png") && folder_.has("x00001.png") && folder_.has("y.gif"));
  EXPECT_THAT(folder_.read("y.d"),
              HasSubstr(folder_ / "x00000.png" + " " + (folder_ / "y.gif") + " " +
                        (folder_ / "y.webp") + " " + (folder_ / "x00001.png") + ": "));
}

TEST_F(Command, AnAnimationThatBreaksLeavesNothing) {
  const Environment openscad("OPENSCAD", folder_.script("openscad", kAnimated));
  const Environment broken("BROKEN_AT", "0.5");
  const std::string scad = folder_.write("a.scad", "sphere(1 + $t);");
  const auto names = folder_.names();
  const Outcome outcome = run({"-o", png_, "--animate=2", scad});
  EXPECT_EQ(outcome.code, ExitCode::kFailure);
  EXPECT_EQ(drawings_, 1);
  EXPECT_EQ(folder_.names(), names);
  run({"-o", folder_ / "x.gif", "--animate=2", scad});
  EXPECT_EQ(drawings_, 2);
  EXPECT_EQ(folder_.names(), names);
  drawings_ = 1;
  // Failures that can be foreseen are.
  std::filesystem::create_directory(folder_ / "x00001.png");
  EXPECT_THAT(run({"-o", png_, "--animate=2", scad}).err, HasSubstr("x00001.png: error: "));
  EXPECT_EQ(drawings_, 1);
}

// make can follow the rule.
TEST_F(Command, MakeDrawsAgainWhatItReads) {
  if (std::system("(command -v openscad && command -v make) >/dev/null") != 0)
    GTEST_SKIP() << "no openscad or make";
  const std::string part = "a part: 100%; #1 $x = [y].scad";
  folder_.write(part, "module part() sphere(1);");
  const std::string scad = folder_.write("a.scad", "use <" + part + ">\npart();");
  EXPECT_EQ(run({"-o", png_, "-d", folder_ / "x.d", scad}).err, "");
  folder_.write("makefile", png_ + ":\n\techo drawn again\n-include x.d\n");
  const auto make = [this] {
    const std::string command =
        "make -s -C '" + folder_.path() + "' " + png_ + " >" + folder_ / "said";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return folder_.read("said");
  };
  const auto set_age = [](const std::string& path, int hours) {
    std::filesystem::last_write_time(
        path, std::filesystem::file_time_type::clock::now() - std::chrono::hours(hours));
  };
  set_age(scad, 3);
  set_age(folder_ / part, 3);
  set_age(png_, 2);
  EXPECT_THAT(make(), testing::Not(HasSubstr("drawn again")));
  set_age(folder_ / part, 1);
  EXPECT_EQ(make(), "drawn again\n");
}

TEST_F(Command, PlacesInAnExportedCsgAreNotShownAsPlacesInTheScad) {
  const Environment openscad("OPENSCAD", folder_.script("openscad", "echo 'cube(1e308);'"));
  const std::string scad = folder_.write("a.scad", "// a comment\ntext(1);");
  EXPECT_THAT(run({"-o", png_, scad}).err,
              StartsWith(scad + " (its .csg):1:1: warning: cube is left out"));
}

TEST_F(Command, AFailedExportLeavesNothing) {
  const Environment openscad(
      "OPENSCAD", folder_.script("openscad", "echo 'sphere(r = 1);'; echo 'ERROR: no' >&2"));
  const std::string scad = folder_.write("a.scad", "sphere(1);");
  const Outcome outcome = run({"-q", "-o", png_, scad});
  EXPECT_EQ(outcome.code, ExitCode::kFailure);
  EXPECT_EQ(outcome.err, scad + ": error: no\n");
  EXPECT_FALSE(folder_.has("x.png"));
}

TEST_F(Command, InterruptionLeavesNoOutputAndAnOldOneUntouched) {
  folder_.write("x.png", "before");
  const std::string started = folder_ / "started";
  for (const int signal_number : {SIGINT, SIGTERM}) {
    const pid_t pid = fork();
    if (pid == 0) {
      handle_interrupts();
      const Renderer endless = [&](const auto&, const auto&, const auto&, auto&) -> Image {
        folder_.write("started", "");
        while (true) pause();
      };
      run_command({"-o", png_, "-o", folder_ / "y.exr", file_}, endless);
      _exit(99);
    }
    while (!folder_.has("started")) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    kill(pid, signal_number);
    int status = 0;
    waitpid(pid, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1);
    std::filesystem::remove(started);
    EXPECT_THAT(folder_.names(), ElementsAre("a.csg", "x.png"));
    EXPECT_EQ(folder_.read("x.png"), "before");
  }
}

TEST_F(Command, NoProgressInAPipe) {
  renderer_ = [this](const auto& scene, const auto& view, const RenderSettings& settings,
                     RenderStats& stats) {
    std::this_thread::sleep_for(ProgressLine::kSilence + std::chrono::milliseconds(50));
    settings.progress("subdivide", 0.5);
    return draw(scene, view, settings, stats);
  };
  EXPECT_EQ(run({"-o", png_, file_}).err, "");
}

TEST(Progress, ShowsOneLineAfterHalfASecondAndRemovesIt) {
  testing::internal::CaptureStderr();
  {
    ProgressLine line(true);
    line.update("early", 0.1);
    std::this_thread::sleep_for(ProgressLine::kSilence + std::chrono::milliseconds(20));
    line.update("subdivide", 0.5);
    line.update("too soon", 0.6);
    std::this_thread::sleep_for(ProgressLine::kInterval + std::chrono::milliseconds(20));
    line.update("openscad", -1);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "\r\033[Ksubdivide  50%\r\033[Kopenscad ...\r\033[K");
}

TEST(Progress, DisabledSaysNothing) {
  testing::internal::CaptureStderr();
  {
    ProgressLine line(false);
    std::this_thread::sleep_for(ProgressLine::kSilence + std::chrono::milliseconds(20));
    line.update("subdivide", 0.5);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace frontend
