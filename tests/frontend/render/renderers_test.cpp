// Tests the command with its two renderers: both have the same options and pictures, and `auto`
// chooses between them.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "frontend/camera.hpp"
#include "frontend/command.hpp"
#include "frontend/error.hpp"
#include "frontend/scene_renderer.hpp"
#include "render/renderer_choice.hpp"
#include "support/models.hpp"
#include "support/test_meshes.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// A ball with a hole, a ball bitten away with a colour, a `#` part in the hole and a `%` part that
/// stands in front of one side.
constexpr const char* kDesign = R"(
difference() {
  sphere($fn = 0, r = 10);
  cylinder($fn = 0, h = 30, r1 = 4, r2 = 4, center = true);
  #multmatrix([[1, 0, 0, 8], [0, 1, 0, 0], [0, 0, 1, 4], [0, 0, 0, 1]]) {
    sphere($fn = 0, r = 4);
  }
}
color([0.2, 0.4, 1, 1]) {
  multmatrix([[1, 0, 0, 12], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {
    cylinder($fn = 0, h = 9, r1 = 5, r2 = 0, center = false);
  }
}
%multmatrix([[1, 0, 0, -6], [0, 1, 0, -9], [0, 0, 1, 0], [0, 0, 0, 1]]) {
  sphere($fn = 0, r = 5);
}
)";

struct Drawn {
  ExitCode code = ExitCode::kDone;
  std::string err;
  Image image;
  RenderStats stats;
};

class Renderers : public testing::Test {
 protected:
  Renderers() : file_(folder_.write("a.csg", kDesign)) {}

  /// Runs the command with these options on a small picture, and returns what it drew, before
  /// encoding.
  Drawn run(std::vector<std::string> options) {
    Drawn drawn;
    options.insert(options.begin(), {"-o", folder_ / "x.png", "--imgsize=160,120", file_});
    const Renderer renderer = [&](const auto& scene, const auto& view, const auto& settings,
                                  RenderStats& stats) {
      SceneRenderer scene_renderer(folders_);
      scene_renderer.load(std::make_shared<const csgcore::Scene>(scene));
      drawn.image = scene_renderer.draw(view, settings, stats);
      drawn.stats = stats;
      return drawn.image;
    };
    testing::internal::CaptureStderr();
    drawn.code = run_command(options, renderer);
    drawn.err = testing::internal::GetCapturedStderr();
    return drawn;
  }

  Drawn cpu(std::vector<std::string> options = {}) {
    options.push_back("--renderer=cpu");
    return run(options);
  }
  Drawn gl(std::vector<std::string> options = {}) {
    options.push_back("--renderer=gl");
    return run(options);
  }

  /// Imitates a machine with a GPU, as far as can be seen from outside.
  void feign_gpu() {
    folders_ = {folder_ / "dri", folder_ / "drm"};
    std::filesystem::create_directories(folders_.devices);
    std::ofstream(folders_.devices + "/renderD128") << "";
    std::filesystem::create_directories(folders_.classes + "/renderD128/device");
    std::filesystem::create_symlink("i915", folders_.classes + "/renderD128/device/driver");
  }

  TemporaryFolder folder_;
  std::string file_;
  GpuFolders folders_{folder_ / "none", folder_ / "none"};
};

/// Two renderers round a colour differently, by at most a level, and one more where it is blended.
constexpr int kLevels = 2;

int levels_apart(const Image& a, const Image& b, size_t pixel) {
  int most = 0;
  for (size_t channel = 0; channel < 3; ++channel) {
    most = std::max(most, std::abs(int{a.rgb[pixel][channel]} - int{b.rgb[pixel][channel]}));
  }
  return most;
}

/// Returns the number of pixels whose colours differ. At an edge one renderer may just miss what
/// the other hits.
size_t different_pixels(const Image& a, const Image& b) {
  EXPECT_EQ(a.rgb.size(), b.rgb.size());
  size_t count = 0;
  for (size_t i = 0; i < std::min(a.rgb.size(), b.rgb.size()); ++i) {
    count += levels_apart(a, b, i) > kLevels;
  }
  return count;
}

size_t pixels_unlike(const Image& image, const std::array<uint8_t, 3>& color) {
  return image.rgb.size() -
         static_cast<size_t>(std::count(image.rgb.begin(), image.rgb.end(), color));
}

/// The most of the 19,200 pixels that may be that near to an edge.
constexpr size_t kEdgePixels = 4;

TEST_F(Renderers, ABackgroundMayBeAGradient) {
  const auto expect_gradient = [](const Image& image) {
    constexpr double kAbove[] = {0x87, 0xce, 0xeb}, kBelow[] = {0xc9, 0xe9, 0xf6};
    ASSERT_FALSE(image.rgb.empty());
    for (size_t y = 0; y < image.height_px; ++y) {
      const double below = (static_cast<double>(y) + 0.5) / image.height_px;
      for (size_t channel = 0; channel < 3; ++channel) {
        const double expected = kAbove[channel] * (1 - below) + kBelow[channel] * below;
        EXPECT_NEAR(image.rgb[y * image.width_px][channel], expected, 1) << y;
      }
    }
  };
  for (const char* option :
       {"--info", "--technique=cells", "--samples=4", "--shading=studio", "--show=cells"}) {
    SCOPED_TRACE(option);
    expect_gradient(cpu({"--colorscheme=ClearSky", option}).image);
    expect_gradient(gl({"--colorscheme=ClearSky", option}).image);
  }
  // Of a translucent model layers alone are drawn.
  folder_.write("a.csg", "color([1, 0, 0, 0.5]) { sphere($fn = 0, r = 10); }");
  expect_gradient(cpu({"--colorscheme=ClearSky"}).image);
}

TEST_F(Renderers, DrawTheSamePicture) {
  const std::vector<std::vector<std::string>> cases = {
      {},
      {"--shading=phong"},
      {"--shading=phong", "--shadows=1"},
      {"--shading=phong", "--shadows=0.5", "--samples=4"},
      {"--projection=o"},
      {"--camera=-6,-9,0,30,0,0,3"},  // inside the translucent part
      {"--camera=0,0,0,90,0,0,7"},    // inside the hole
      {"--samples=4"},
      {"--threshold=1", "--leaf-primitives=2"},
      {"--show=cells", "--leaf-primitives=1"},
      {"--show=cells", "--leaf-primitives=1", "--shading=phong", "--projection=o"},
      {"--show=cells", "--camera=0,0,0,30,20,0,9"},  // inside a cell
  };
  for (const auto& options : cases) {
    SCOPED_TRACE(testing::PrintToString(options));
    const Drawn a = cpu(options);
    const Drawn b = gl(options);
    EXPECT_EQ(a.err, "");
    EXPECT_EQ(a.stats.technique, b.stats.technique);
    EXPECT_LE(different_pixels(a.image, b.image), kEdgePixels);
    std::vector<std::string> by_cells = options;
    by_cells.push_back("--technique=cells");
    const Drawn c = gl(by_cells);
    EXPECT_EQ(c.stats.technique, "cells");
    EXPECT_LE(different_pixels(a.image, c.image), kEdgePixels);
    EXPECT_GT(pixels_unlike(a.image, {0xff, 0xff, 0xe5}), 1000u) << "nothing to compare";
  }
}

/// From a negative distance an orthographic picture is upside down, and lit accordingly.
TEST_F(Renderers, MirrorOrthographicPicturesAlike) {
  const std::vector<std::vector<std::string>> ways = {
      {"--technique=tiles"},
      {"--technique=cells"},
      {"--samples=4"},
      {"--shading=phong", "--technique=cells"},
      {"--show=cells", "--leaf-primitives=1"},
  };
  for (std::vector<std::string> way : ways) {
    SCOPED_TRACE(testing::PrintToString(way));
    way.insert(way.end(), {"--projection=o", "-o", folder_ / "x.exr"});
    const auto with_distance = [&](const char* camera) {
      std::vector<std::string> words = way;
      words.push_back(camera);
      return words;
    };
    const Image upright = cpu(with_distance("--camera=0,0,0,55,0,25,70")).image;
    const auto mirrored = with_distance("--camera=0,0,0,55,0,25,-70");
    const Image image = cpu(mirrored).image;
    EXPECT_LE(different_pixels(image, gl(mirrored).image), kEdgePixels);
    for (uint32_t y = 0; y < image.height_px; ++y) {
      for (uint32_t x = 0; x < image.width_px; ++x) {
        const size_t here = size_t{y} * image.width_px + x;
        const size_t there = size_t{image.height_px - 1 - y} * image.width_px + x;
        ASSERT_EQ(image.id[here], upright.id[there]) << x << ' ' << y;
        ASSERT_EQ(image.z[here], upright.z[there]) << x << ' ' << y;
      }
    }
    EXPECT_GT(pixels_unlike(image, {0xff, 0xff, 0xe5}), 1000u) << "nothing to compare";
  }
}

TEST_F(Renderers, ShadeAsTheyAreTold) {
  for (const char* renderer : {"--renderer=cpu", "--renderer=gl"}) {
    const Image openscad = run({renderer, "--shading=openscad"}).image;
    const Image phong = run({renderer, "--shading=phong"}).image;
    EXPECT_GT(different_pixels(phong, run({renderer, "--shading=phong", "--shadows=1"}).image),
              100u);
    EXPECT_EQ(run({renderer}).image.rgb, openscad.rgb);
    EXPECT_GT(different_pixels(openscad, phong), 1000u) << renderer;
  }
}

TEST_F(Renderers, FillTheSameChannels) {
  for (const char* show : {"depth", "normals", "id"}) {
    const std::string option = std::string("--show=") + show;
    const Image a = cpu({option}).image;
    const Image b = gl({option}).image;
    size_t different = 0;
    ASSERT_EQ(a.z.size(), b.z.size());
    for (size_t i = 0; i < a.z.size(); ++i) {
      if (std::isinf(a.z[i]) || std::isinf(b.z[i]) || a.id[i] != b.id[i]) {
        different += a.z[i] != b.z[i];
        continue;
      }
      // Float against double: some ulps of the scene's size, and more where a ray grazes.
      different += std::abs(a.z[i] - b.z[i]) > 1e-3f ||
                   glm::length(a.position[i] - b.position[i]) > 1e-3f ||
                   glm::length(a.normal[i] - b.normal[i]) > 1e-3f;
    }
    EXPECT_LE(different, kEdgePixels) << show;
    EXPECT_LT(*std::min_element(a.z.begin(), a.z.end()), 1000.0f);
  }
}

TEST_F(Renderers, TechniquesDrawTheSameOnTheCpu) {
  for (const char* shading : {"--shading=openscad", "--shading=phong"}) {
    const Drawn tiles = cpu({shading, "--technique=tiles", "-o", folder_ / "x.exr"});
    const Drawn cells = cpu({shading, "--technique=cells", "-o", folder_ / "x.exr"});
    EXPECT_EQ(tiles.image.rgb, cells.image.rgb);
    EXPECT_EQ(tiles.image.z, cells.image.z);
    EXPECT_EQ(tiles.image.id, cells.image.id);
    EXPECT_EQ(tiles.stats.technique, "tiles");
    EXPECT_EQ(cells.stats.technique, "cells");
    EXPECT_EQ(tiles.stats.cells, 0u);
    EXPECT_GT(cells.stats.cells, 0u);
    EXPECT_GT(tiles.stats.trace.tiles, 0u);
    EXPECT_EQ(cells.stats.trace.tiles, 0u);
  }
}

TEST_F(Renderers, TheTechniqueOfASinglePictureIsTiles) {
  EXPECT_EQ(cpu().stats.technique, "tiles");
  EXPECT_EQ(cpu({"--leaf-primitives=8"}).stats.technique, "cells");
  EXPECT_EQ(cpu({"--threshold=0.5"}).stats.technique, "cells");
  EXPECT_EQ(cpu({"--show=cells"}).stats.technique, "cells");
  for (const Drawn& drawn : {gl(), gl({"--technique=tiles"})}) {
    EXPECT_EQ(drawn.stats.technique, "tiles");
    EXPECT_EQ(drawn.err, "");
    EXPECT_GT(drawn.stats.trace.tiles, 0u);
    EXPECT_EQ(drawn.stats.cells, 0u);
    EXPECT_EQ(drawn.stats.cells_drawn, 0u);
  }
  for (const char* option : {"--leaf-primitives=8", "--threshold=0.5", "--show=cells"}) {
    const Drawn drawn = gl({option});
    EXPECT_EQ(drawn.stats.technique, "cells");
    EXPECT_EQ(drawn.stats.trace.tiles, 0u);
    EXPECT_GT(drawn.stats.cells_drawn, 0u);
  }
}

/// Each ray meets more primitives than a tile can have.
TEST_F(Renderers, OpenGlTakesCellsWhereTilesHaveTooMuch) {
  std::string balls = "intersection() {";
  for (int i = 0; i < 200; ++i) balls += "sphere($fn = 0, r = " + std::to_string(10 + i) + ");\n";
  file_ = folder_.write("balls.csg", balls + "}");
  const std::vector<std::string> options = {"--camera=0,0,0,5,0,0,50"};
  const Drawn drawn = gl(options);
  EXPECT_EQ(drawn.stats.technique, "cells");
  EXPECT_EQ(drawn.err, "");
  EXPECT_LE(different_pixels(drawn.image, cpu(options).image), kEdgePixels);
  std::vector<std::string> by_tiles = options;
  by_tiles.push_back("--technique=tiles");
  EXPECT_THAT(gl(by_tiles).err, HasSubstr("drawn cells"));
}

TEST_F(Renderers, StatisticsOfTheCpu) {
  for (const char* technique : {"--technique=tiles", "--technique=cells"}) {
    SCOPED_TRACE(technique);
    const Drawn drawn = cpu({technique, "--stats", folder_ / "s.json"});
    const csgcore::TraceStats& trace = drawn.stats.trace;
    EXPECT_EQ(drawn.stats.renderer, "cpu");
    EXPECT_EQ(drawn.stats.primitives, 5u);
    EXPECT_GT(trace.rays, 1000u);
    EXPECT_GT(trace.intersections, 1000u);
    EXPECT_LE(trace.intersections, trace.rays * drawn.stats.primitives);
    EXPECT_EQ(trace.edge_pixels, 0u);
    EXPECT_GT(trace.trace_ms, 0);
    EXPECT_DOUBLE_EQ(drawn.stats.render_ms, trace.cull_ms + trace.trace_ms);
    EXPECT_GT(drawn.stats.prepare_ms, 0);
    EXPECT_EQ(drawn.stats.context_ms, 0);
    EXPECT_EQ(drawn.stats.measuring_ms, 0);
    EXPECT_EQ(drawn.stats.draw_calls, 0u);
  }
}

/// Nothing is left of the model: no cell has a surface, and no ray meets any of it.
TEST_F(Renderers, AModelThatIsNowhereLeavesTranslucentPartsAlone) {
  struct Case {
    std::string design;
    bool is_seen;
  };
  const std::string cube = "cube(size = [1, 1, 1]);";
  const Case cases[] = {
      {"%" + cube, true},
      {"#" + cube, true},
      {"difference() { %" + cube + " }", true},
      {"intersection() { " + cube + " multmatrix([[1, 0, 0, 5]]) { " + cube + " } }", false},
      {"difference() { " + cube + " cube(size = 3, center = true); }", false},
  };
  const std::vector<std::vector<std::string>> ways = {
      {"--technique=tiles"}, {"--technique=cells"},
      {"--show=cells"},      {"--show=cells", "--view=axes,edges", "--shading=phong"},
      {"--samples=4"},       {"--show=depth"}};
  for (const Case& each : cases) {
    file_ = folder_.write("a.csg", each.design);
    for (const std::vector<std::string>& way : ways) {
      SCOPED_TRACE(each.design + " " + testing::PrintToString(way));
      const Drawn plain = cpu(way);
      std::vector<std::string> counted = way;
      counted.insert(counted.end(), {"--stats", folder_ / "s.json"});
      const Drawn by_cpu = cpu(counted);
      const Drawn by_gl = gl(counted);
      for (const Drawn* drawn : {&plain, &by_cpu, &by_gl}) {
        EXPECT_EQ(drawn->code, ExitCode::kDone);
        EXPECT_EQ(drawn->err, "");
      }
      EXPECT_EQ(by_cpu.image.rgb, plain.image.rgb);
      EXPECT_LE(different_pixels(by_cpu.image, by_gl.image), kEdgePixels);
      // Only the model has cells.
      const bool is_seen = each.is_seen && (way[0] != "--show=cells" || each.design[0] == '#');
      EXPECT_EQ(pixels_unlike(by_cpu.image, {0xff, 0xff, 0xe5}) > 0, is_seen);
    }
  }
}

TEST_F(Renderers, StatisticsOfOpenGl) {
  const Drawn tiles = gl({"--stats", folder_ / "s.json"});
  EXPECT_THAT(tiles.stats.renderer, StartsWith("gl: "));
  EXPECT_GT(tiles.stats.draw_calls, 0u);
  EXPECT_GT(tiles.stats.traverse_ms, 0);
  EXPECT_GT(tiles.stats.render_ms, 0);
  EXPECT_EQ(tiles.stats.paper_tr_ms, 0) << "the paper's are of cells";
  const Drawn drawn = gl({"--technique=cells", "--stats", folder_ / "s.json"});
  EXPECT_THAT(drawn.stats.renderer, StartsWith("gl: "));
  EXPECT_GT(drawn.stats.draw_calls, 0u);
  EXPECT_GT(drawn.stats.measuring_ms, 0);
  EXPECT_GT(drawn.stats.paper_tr_ms, 0);
  EXPECT_GT(drawn.stats.context_ms, 0);
  EXPECT_EQ(drawn.stats.trace.rays, 0u);
}

/// Edges have colours between those of their two sides, and no others.
TEST_F(Renderers, SamplesSmoothEdges) {
  file_ = folder_.write("ball.csg", "sphere($fn = 0, r = 1);\n");
  const Drawn coarse = cpu({"--show=surface"});
  const Drawn fine = cpu({"--samples=16", "-o", folder_ / "x.exr"});
  EXPECT_GT(fine.stats.trace.edge_pixels, 100u);
  EXPECT_LT(fine.stats.trace.edge_pixels, 19200u / 4);
  const size_t changed = different_pixels(coarse.image, fine.image);
  EXPECT_GT(changed, 50u);
  EXPECT_LE(changed, fine.stats.trace.edge_pixels);
  // The channels are those of the pixels' centres.
  EXPECT_EQ(fine.image.z, cpu({"-o", folder_ / "x.exr"}).image.z);
  EXPECT_EQ(cpu({"--samples=16", "--show=normals"}).stats.trace.edge_pixels, 0u);
}

TEST_F(Renderers, SamplesLeaveNoSeamAroundTranslucentParts) {
  // A translucent ball in front of a wall: at its edge there are only wall and ball.
  file_ = folder_.write("a.csg",
                        "%multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,9],[0,0,0,1]]) sphere(r = 2);"
                        "cylinder(h = 1, r1 = 50, r2 = 50, center = false);");
  const std::vector<std::string> options = {"--camera=0,0,0,0,0,0,40", "--projection=o"};
  std::vector<std::string> fine = options;
  fine.push_back("--samples=16");
  EXPECT_EQ(cpu(options).image.rgb, cpu(fine).image.rgb);
}

TEST_F(Renderers, AutoTakesTheCpuWhereThereIsNoGpu) {
  const Drawn drawn = run({"--info"});
  EXPECT_EQ(drawn.stats.renderer, "cpu");
  EXPECT_THAT(drawn.err, AllOf(StartsWith("renderer: cpu (no GPU: "), HasSubstr("none")));
  EXPECT_EQ(cpu({"--info"}).err, "renderer: cpu\n");
}

TEST_F(Renderers, AutoTakesTheCpuWhereOpenGlRunsInSoftware) {
  const std::string name = gl().stats.renderer;
  feign_gpu();
  const Drawn drawn = run({"--info"});
  if (!is_software(name)) {
    EXPECT_EQ(drawn.stats.renderer, name);
    GTEST_SKIP() << "OpenGL has a GPU here: " << name;
  }
  EXPECT_EQ(drawn.stats.renderer, "cpu");
  EXPECT_THAT(drawn.err, StartsWith("renderer: cpu (OpenGL runs in software here: "));
  EXPECT_GT(drawn.stats.context_ms, 0) << "lost on starting OpenGL";
  EXPECT_EQ(drawn.image.rgb, cpu().image.rgb);
}

TEST_F(Renderers, AutoTakesTheCpuForMeshesThatTheDriverCannotHold) {
  feign_gpu();
  SceneRenderer renderer(folders_, {.takes_software = true, .most_texels = 65536});
  const auto draw = [&](uint32_t around) {
    renderer.load(std::make_shared<const csgcore::Scene>(test_support::scene_of(
        csgcore::Op::kUnion,
        {csgcore::make_mesh(test_support::torus_parts(3, 1, around, 50).mesh())})));
    CameraOptions camera;
    camera.width_px = camera.height_px = 40;
    RenderStats stats;
    const Image image = renderer.draw(make_view({csgcore::Vec3(0), {55, 0, 25}, 20}, camera),
                                      RenderSettings{}, stats);
    EXPECT_GT(std::ranges::count(image.rgb, image.rgb[0]), 0);
    EXPECT_LT(std::ranges::count(image.rgb, image.rgb[0]), 1600);
    return stats;
  };
  const RenderStats small = draw(100);
  EXPECT_THAT(small.renderer, StartsWith("gl: "));
  EXPECT_EQ(small.reason, "");
  const RenderStats large = draw(200);
  EXPECT_EQ(large.renderer, "cpu");
  EXPECT_THAT(large.reason, HasSubstr("triangles of meshes need a buffer of"));
}

/// A window's pictures do not wait for OpenGL: the CPU draws until it has what each of them needs.
class WithoutWaiting : public Renderers {
 protected:
  WithoutWaiting() {
    CameraOptions camera;
    camera.width_px = 80;
    camera.height_px = 60;
    view_ = make_view({csgcore::Vec3(0), {55, 0, 25}, 60}, camera);
    settings_.renderer = RendererKind::kGl;
    settings_.waits_for_shaders = false;
  }
  void load(const csgcore::Primitive& primitive) {
    renderer_.load(std::make_shared<const csgcore::Scene>(
        test_support::scene_of(csgcore::Op::kUnion, {primitive})));
  }
  Drawn draw() {
    Drawn drawn;
    drawn.image = renderer_.draw(view_, settings_, drawn.stats);
    return drawn;
  }
  Drawn draw_until_gl() {
    Drawn drawn = draw();
    while (drawn.stats.renderer == "cpu") {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      drawn = draw();
    }
    return drawn;
  }

  SceneRenderer renderer_;
  csgcore::View view_;
  RenderSettings settings_;
};

TEST_F(WithoutWaiting, TheCpuDrawsUntilTheShadersAreThere) {
  load(csgcore::make_sphere(10));
  const Drawn first = draw();
  EXPECT_EQ(first.stats.renderer, "cpu");
  EXPECT_THAT(first.stats.reason, HasSubstr("not compiled yet"));
  const Drawn ready = draw_until_gl();
  EXPECT_THAT(ready.stats.renderer, StartsWith("gl: "));
  EXPECT_EQ(ready.stats.reason, "");
  EXPECT_LE(different_pixels(first.image, ready.image), kEdgePixels);
  EXPECT_THAT(draw().stats.renderer, StartsWith("gl: "));

  // Another kind of primitive needs another shader, and its scene may change while that is
  // compiled.
  load(csgcore::make_frustum(0, 12, 10, 4));
  EXPECT_EQ(draw().stats.renderer, "cpu");
  load(csgcore::make_frustum(0, 14, 10, 5));
  const Drawn frustum = draw();
  EXPECT_LE(different_pixels(frustum.image, draw_until_gl().image), kEdgePixels);
}

TEST_F(WithoutWaiting, WhoeverWaitsHasItAtOnce) {
  load(csgcore::make_sphere(10));
  EXPECT_EQ(draw().stats.renderer, "cpu");
  settings_.waits_for_shaders = true;
  EXPECT_THAT(draw().stats.renderer, StartsWith("gl: "));
}

TEST_F(WithoutWaiting, OpenGlThatCannotBeHadIsToldLater) {
  feign_gpu();
  renderer_ = SceneRenderer(folders_, {.most_texels = 1});
  settings_.renderer = RendererKind::kAuto;
  load(csgcore::make_mesh(test_support::torus_parts(3, 1, 20, 10).mesh()));
  RenderStats stats = draw().stats;
  while (stats.reason.find("not compiled yet") != std::string::npos) stats = draw().stats;
  EXPECT_EQ(stats.renderer, "cpu");
  EXPECT_THAT(stats.reason, Not(testing::IsEmpty()));
}

/// Runs in a process of its own, whose EGL finds no driver.
class WithoutAnyOpenGl : public Renderers {
 protected:
  WithoutAnyOpenGl() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
  void check() {
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/none.json", 1);
    setenv("__EGL_VENDOR_LIBRARY_DIRS", "/none", 1);
    feign_gpu();
    const Drawn automatic = run({"--info"});
    const Drawn asked = gl();
    std::fputs((automatic.err + asked.err).c_str(), stderr);
    std::exit(automatic.stats.renderer == "cpu" && asked.code == ExitCode::kFailure ? 0 : 1);
  }
};

TEST_F(WithoutAnyOpenGl, AutoTakesTheCpu) {
  EXPECT_EXIT(check(), testing::ExitedWithCode(0),
              "renderer: cpu \\(no OpenGL 3.3 context.*\n.*error: no OpenGL 3.3 context");
}

/// Lists the libraries that the program loads, as the dynamic linker reports them.
class Program : public testing::Test {
 protected:
  std::string libraries_after(const std::string& renderer) {
    const std::string command = "LD_DEBUG=files LD_DEBUG_OUTPUT=" + (folder_ / "log") + ' ' +
                                SCADRAY_PROGRAM + " -o " + (folder_ / "x.png") +
                                " --imgsize=64,64 --renderer=" + renderer + ' ' + file_;
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::string libraries;
    for (const std::string& name : folder_.names()) {
      if (!name.starts_with("log")) continue;
      std::istringstream log(folder_.read(name));
      for (std::string line; std::getline(log, line);) {
        if (line.find("calling init: ") != std::string::npos) libraries += line + '\n';
      }
    }
    return libraries;
  }

  TemporaryFolder folder_;
  std::string file_ = folder_.write("a.csg", kDesign);
};

/// An empty file in a library's place cannot be loaded, like one that is missing.
TEST_F(Program, SaysWhichGraphicsLibraryIsMissing) {
  const auto error_without = [this](const std::vector<std::string>& libraries) {
    for (const std::string& name : libraries) folder_.write(name, "");
    const std::string command = "LD_LIBRARY_PATH=" + (folder_ / "") + ' ' + SCADRAY_PROGRAM +
                                " -o " + (folder_ / "x.png") + " --renderer=gl " + file_ + " 2>" +
                                (folder_ / "errors");
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
    for (const std::string& name : libraries) std::filesystem::remove(folder_ / name);
    return folder_.read("errors");
  };
  EXPECT_THAT(error_without({"libEGL.so.1"}), HasSubstr("(install libegl1)"));
  EXPECT_THAT(error_without({"libOpenGL.so.0", "libGL.so.1"}), HasSubstr("(install libopengl0)"));
}

TEST_F(Program, LoadsNoGraphicsForAPictureByTheCpu) {
  constexpr const char* kGraphics[] = {"libepoxy", "libGL",   "libEGL",   "libgallium",
                                       "_dri.so",  "libLLVM", "libimgui", "libglfw",
                                       "libX11",   "libCGAL", "libgmp"};
  const std::string by_cpu = libraries_after("cpu");
  EXPECT_THAT(by_cpu, HasSubstr("libstdc++"));
  for (const char* name : kGraphics) EXPECT_THAT(by_cpu, testing::Not(HasSubstr(name)));
}

TEST_F(Program, LoadsEglForAPictureByOpenGl) {
  EXPECT_THAT(libraries_after("gl"), HasSubstr("libEGL"));
}

}  // namespace
}  // namespace frontend
