// Tests the window's pictures, which equal the command's, whatever is ordered meanwhile; and what
// is found at a pixel.
#include "painter.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <condition_variable>
#include <future>
#include <memory>
#include <numbers>
#include <string_view>
#include <utility>

#include "designs.hpp"
#include "follow/followed.hpp"
#include "frontend/importer.hpp"
#include "frontend/overlays.hpp"
#include "frontend/parser.hpp"
#include "frontend/picture_file.hpp"
#include "frontend/render.hpp"
#include "section_hatch.hpp"
#include "section_plane.hpp"
#include "support/models.hpp"

namespace window {
namespace {

using csgcore::Projection;
using csgcore::Vec3;
using frontend::ImportedDesign;
using frontend::Show;
using testing::HasSubstr;

/// A design with translucent parts.
const std::string kDesign = window_test::kBlock +
                            "%sphere($fn = 0, $fa = 12, $fs = 2, r = 14);\n"
                            "#multmatrix([[1, 0, 0, -5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])"
                            " cylinder($fn = 0, h = 30, r1 = 2, r2 = 3, center = false);\n";

/// Less than any picture takes: the next one of a motion is coarse.
constexpr double kNoTime_ms = 1e-6;

std::shared_ptr<const ImportedDesign> design_of(const std::string& text) {
  frontend::ImportOptions options;
  options.keeps_places = true;
  return std::make_shared<ImportedDesign>(
      frontend::import_design(frontend::parse(text, ""), options));
}

std::shared_ptr<const ImportedDesign> design_of(csgcore::Scene scene) {
  auto design = std::make_shared<ImportedDesign>();
  design->view_box = {Vec3(-20), Vec3(20)};
  design->scene = std::move(scene);
  return design;
}

PaintOrder order_of(std::shared_ptr<const ImportedDesign> design) {
  PaintOrder order;
  order.number = 1;
  order.design = std::move(design);
  order.navigation = {{}, Projection::kPerspective};
  order.size = {160, 120};
  order.settings.renderer = frontend::RendererKind::kCpu;
  return order;
}

/// Returns the picture that the command makes.
csgcore::Image command_picture(const PaintOrder& order) {
  const csgcore::View view = order.navigation.view(order.size);
  frontend::RenderSettings settings = order.settings;
  settings.measured_channels = true;
  if (order.overlays.grid) settings.shares_from = csgcore::kNoPrimitive;
  if (order.section.is_on) settings.shares_from = kFirstSectionFace;
  frontend::RenderStats stats;
  CutScene scene{order.design->scene, {}};
  if (order.section.is_on) {
    scene = cut_open(scene.scene, order.section, order.design->view_box, order.design->parts);
  }
  csgcore::Image image = frontend::render(scene.scene, view, settings, stats);
  frontend::show_channel(image, settings.show, settings.scheme.background);
  const auto draw_overlays = [&](const frontend::Overlays& overlays) {
    frontend::draw_overlays(image, view, order.navigation.camera(), overlays, settings.scheme,
                            *order.design);
  };
  frontend::Overlays others = order.overlays;
  others.edges = false;
  draw_overlays({.edges = order.overlays.edges});
  if (settings.show == frontend::Show::kSurface) {
    draw_section_faces(image, view, order.section, scene.parts,
                       hatch_spacing(view, order.navigation.camera().distance));
  }
  draw_overlays(others);
  return image;
}

/// Holds a painter, and waits for it.
class PainterTest : public testing::Test {
 protected:
  Painter& painter(double frame_ms = 1e6) {
    return painter_.emplace(frame_ms, [this] {
      const std::lock_guard lock(mutex_);
      ++news_;
      changed_.notify_all();
    });
  }

  template <typename Take>
  auto next(const Take& take) {
    const auto end = std::chrono::steady_clock::now() + frontend::kPatience;
    std::unique_lock lock(mutex_);
    while (true) {
      const int seen = news_;
      lock.unlock();
      if (auto found = take()) return std::move(*found);
      lock.lock();
      if (!changed_.wait_until(lock, end, [&] { return news_ != seen; })) {
        throw std::runtime_error("nothing comes from the painter");
      }
    }
  }
  Painting next_painting() {
    return next([this] { return painter_->take_painting(); });
  }
  Painting next_final() {
    while (true) {
      Painting painting = next_painting();
      if (painting.is_final || !painting.error.empty()) return painting;
    }
  }
  Finding next_finding() {
    return next([this] { return painter_->take_finding(); });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int news_ = 0;
  std::optional<Painter> painter_;
};

TEST_F(PainterTest, DrawsWhatTheCommandDraws) {
  Painter& painter = this->painter();
  PaintOrder order = order_of(design_of(kDesign));
  const auto check = [&] {
    painter.order(order);
    const Painting painting = next_painting();
    EXPECT_TRUE(painting.is_final);
    EXPECT_EQ(painting.error, "");
    EXPECT_EQ(painting.order.number, order.number);
    EXPECT_TRUE(painting.image.rgb == command_picture(order).rgb);
    EXPECT_EQ(painting.stats.renderer, "cpu");
    ++order.number;
  };
  check();
  for (const Show show : {Show::kCells, Show::kDepth, Show::kNormals, Show::kId, Show::kSurface}) {
    order.settings.show = show;
    check();
  }
  order.overlays = {true, true, true, true};
  check();
  order.section = {false, {0, 1, 0}, true, 2.5};  // off
  check();
  order.settings.samples = 4;
  order.settings.shading = frontend::Shading::kPhong;
  order.navigation = {{{1, 2, 3}, {30, 20, 10}, 80}, Projection::kOrthographic};
  order.size = {200, 100};
  check();
  order.section.is_on = true;
  check();
  order.design = design_of(window_test::kBall);
  check();
}

/// A mesh of 12,000 triangles: a prism whose sides are teeth.
std::string many_teeth() {
  constexpr int kCorners = 3000;
  std::string points, faces, below, above;
  for (int i = 0; i < kCorners; ++i) {
    const double turn = 2 * std::numbers::pi * i / kCorners, radius = 20 + 5 * (i % 2);
    const std::string at = "[" + std::to_string(radius * std::cos(turn)) + ", " +
                           std::to_string(radius * std::sin(turn)) + ", ";
    points += at + "0], " + at + "10], ";
    const int next = (i + 1) % kCorners;
    for (const int corner : {2 * i, 2 * i + 1, 2 * next + 1, 2 * next}) {
      faces += (corner == 2 * i ? "[" : ", ") + std::to_string(corner);
    }
    faces += "], ";
    below += std::to_string(2 * i) + ", ";
    above = std::to_string(2 * i + 1) + ", " + above;
  }
  return "polyhedron(points = [" + points + "], faces = [" + faces + "[" + below + "], [" + above +
         "]], convexity = 1);\n";
}

TEST_F(PainterTest, LightsLargeMeshesByFewerDirectionsAtFirst) {
  PaintOrder order = order_of(design_of(many_teeth()));
  order.settings.shading = frontend::Shading::kStudio;
  PaintOrder lit = order;
  lit.settings.samples = frontend::kStudioSamples;
  lit.settings.studio.directions = 45;
  const auto wanted = command_picture(lit).rgb;
  painter().order(order);
  Painting painting = next_painting();
  while (!painting.is_final && painting.image.rgb != wanted) painting = next_painting();
  EXPECT_TRUE(painting.image.rgb == wanted);
}

TEST_F(PainterTest, LightsAStudioInSteps) {
  PaintOrder order = order_of(design_of(window_test::kBlock));
  order.settings.shading = frontend::Shading::kStudio;
  PaintOrder final = order, lit = order, colors = order;
  final.settings.samples = lit.settings.samples = frontend::kStudioSamples;
  final.settings.studio.shares_light = false;
  lit.settings.studio = first_light(order.design->scene, lit.settings.studio);
  colors.settings.studio = {0, 0, 0};
  for (const bool is_moving : {false, true}) {
    std::vector<Painting> steps;
    std::promise<void> is_done;
    // No step is missed where the painter's thread takes them itself.
    std::unique_ptr<Painter> painter;
    std::promise<void> is_made;
    painter = std::make_unique<Painter>(1e6, [&, made = is_made.get_future().share()] {
      made.wait();
      steps.push_back(*painter->take_painting());
      if (steps.back().is_final) is_done.set_value();
    });
    is_made.set_value();
    order.is_moving = is_moving;
    painter->order(order);
    is_done.get_future().wait();
    ASSERT_EQ(steps.size(), 3u);
    EXPECT_TRUE(steps[0].image.rgb == command_picture(colors).rgb);
    EXPECT_TRUE(steps[1].image.rgb == command_picture(lit).rgb);
    EXPECT_TRUE(steps[2].image.rgb == command_picture(final).rgb);
    // What the design itself took to draw stays known.
    EXPECT_EQ(steps[0].light_ms, 0);
    for (const Painting& step : {steps[1], steps[2]}) {
      EXPECT_GT(step.light_ms, 0);
      EXPECT_EQ(step.stats.render_ms, steps[0].stats.render_ms);
    }
  }
}

TEST_F(PainterTest, HatchesTheCutFacesOfPartsWithModifiers) {
  // The middle of a cut ball, which looks at the eye, beside the same of a ball that is only cut.
  const auto middle = [&](const std::string& text, frontend::Translucency order_of_blending) {
    PaintOrder order = order_of(design_of(text + window_test::kBall));
    order.navigation = {{{0, 0, 0}, {0, 0, 0}, 80}, Projection::kOrthographic};
    order.settings.translucency = order_of_blending;
    order.section = {true, {0, 0, 1}, false, 0};
    painter().order(order);
    const Painting painting = next_final();
    std::vector<int> row;
    for (uint32_t x = 70; x < 90; ++x) row.push_back(painting.image.rgb[60 * 160 + x][1]);
    return row;
  };
  using frontend::Translucency;
  for (const Translucency order : {Translucency::kFile, Translucency::kDepth}) {
    const auto contrast = [&](const std::string& text) {
      const std::vector<int> row = middle(text, order);
      return std::ranges::max(row) - std::ranges::min(row);
    };
    const int opaque = contrast("");
    EXPECT_GT(opaque, 40);
    for (const std::string modifier : {"%", "#"}) {
      EXPECT_GT(contrast(modifier), opaque / 5) << modifier;
      EXPECT_LT(contrast(modifier), opaque) << modifier;
    }
  }
}

TEST_F(PainterTest, DrawsWhatIsEmpty) {
  Painter& painter = this->painter();
  const std::string cubes = "{ cube(1); multmatrix([[1, 0, 0, 5]]) { cube(1); } }";
  PaintOrder order;
  uint64_t number = 0;
  // One renderer draws these designs one after the other.
  const std::string designs[] = {"",
                                 "%cube(1);",
                                 "intersection() " + cubes,
                                 "cube(0);",
                                 "union() " + cubes,
                                 "#cube(1);",
                                 "intersection() " + cubes,
                                 "%cube(1);",
                                 ""};
  for (const std::string& design : designs) {
    for (const bool is_cut : {false, true}) {
      for (const Show show : {Show::kSurface, Show::kCells, Show::kDepth, Show::kNormals}) {
        SCOPED_TRACE(design + (is_cut ? ", cut, " : ", ") + std::to_string(static_cast<int>(show)));
        order = order_of(design_of(design));
        order.number = ++number;
        order.settings.show = show;
        order.settings.all_stats = true;
        order.overlays = {true, true, true, true};
        order.section = {is_cut, {1, 0, 0}, false, 0.5};
        painter.order(order);
        const Painting painting = next_final();
        EXPECT_EQ(painting.error, "");
        EXPECT_TRUE(painting.image.rgb == command_picture(order).rgb);
      }
    }
  }
  Probe probe;
  probe.order = order;
  painter.probe(probe);
  EXPECT_FALSE(next_finding().is_hit);
}

TEST_F(PainterTest, MeasuresWhereItIsAskedTo) {
  Painter& painter = this->painter();
  PaintOrder order = order_of(design_of(kDesign));
  order.settings.measured_channels = true;
  painter.order(order);
  const Painting painting = next_painting();
  const csgcore::Image wanted = command_picture(order);
  EXPECT_EQ(painting.image.z, wanted.z);
  EXPECT_EQ(painting.image.id, wanted.id);
  EXPECT_EQ(painting.image.normal, wanted.normal);
  EXPECT_EQ(painting.image.position, wanted.position);
}

TEST_F(PainterTest, WhatMovesIsCoarseAndThenRefined) {
  Painter& painter = this->painter(kNoTime_ms);
  PaintOrder order = order_of(design_of(kDesign));
  painter.order(order);
  EXPECT_TRUE(next_painting().is_final);  // the camera does not move
  order.settings.samples = 4;
  order.is_moving = true;
  order.navigation.turn(10, 5, false);
  ++order.number;
  painter.order(order);
  const Painting coarse = next_painting();
  EXPECT_FALSE(coarse.is_final);
  EXPECT_LT(coarse.image.width_px, 160u);
  EXPECT_LT(coarse.image.height_px, 120u);
  EXPECT_EQ(coarse.image.rgb.size(), size_t{coarse.image.width_px} * coarse.image.height_px);
  const Painting refined = next_painting();
  EXPECT_TRUE(refined.is_final);
  EXPECT_EQ(refined.order.number, order.number);
  EXPECT_TRUE(refined.image.rgb == command_picture(order).rgb);
}

TEST_F(PainterTest, TheFirstEditOfAMotionShowsWhetherTheOthersAreQuick) {
  Painter& painter = this->painter(kNoTime_ms);
  PaintOrder order = order_of(design_of(window_test::row_of(1)));
  painter.order(order);
  EXPECT_TRUE(next_painting().is_final);
  const auto edit = [&](int spheres) {
    order.design = design_of(window_test::row_of(spheres));
    order.is_moving = true;
    ++order.number;
    painter.order(order);
    return next_painting();
  };
  EXPECT_TRUE(edit(2).is_final);
  EXPECT_FALSE(edit(3).is_final);
  const Painting refined = next_painting();
  EXPECT_TRUE(refined.is_final);
  EXPECT_TRUE(refined.image.rgb == command_picture(order).rgb);
  order.navigation.turn(10, 5, false);
  EXPECT_FALSE(edit(4).is_final) << "the view moves, too";
}

TEST_F(PainterTest, AStoppedPictureIsNeitherFinishedNorRefined) {
  Painter& painter = this->painter(kNoTime_ms);
  PaintOrder order = order_of(design_of(kDesign));
  painter.order(order);
  EXPECT_TRUE(next_painting().is_final);
  for (const bool is_moving : {false, true}) {
    order.design = design_of(test_support::cylinder_minus_spheres(100000));
    order.is_moving = is_moving;
    ++order.number;
    painter.order(order);
    while (!painter.activity()) std::this_thread::yield();
    painter.stop();
    while (painter.activity()) std::this_thread::yield();
    EXPECT_FALSE(painter.take_painting());
  }
  order.design = design_of(kDesign);
  order.navigation.turn(10, 5, false);  // the first edit in a view is drawn whole
  ++order.number;
  painter.order(order);
  EXPECT_FALSE(next_painting().is_final);
  painter.stop();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_FALSE(painter.take_painting());
  order.is_moving = false;
  ++order.number;
  painter.order(order);
  EXPECT_EQ(next_painting().order.number, order.number);
}

TEST_F(PainterTest, WhatIsQuickEnoughIsDrawnWholeAtOnce) {
  Painter& painter = this->painter();
  PaintOrder order = order_of(design_of(kDesign));
  order.is_moving = true;
  painter.order(order);
  EXPECT_TRUE(next_painting().is_final);
  ++order.number;
  painter.order(order);
  EXPECT_TRUE(next_painting().is_final);
}

TEST_F(PainterTest, ANewerOrderReplacesAnOlderOne) {
  Painter& painter = this->painter();
  PaintOrder order = order_of(design_of(test_support::cylinder_minus_spheres(300)));
  uint64_t last = 0;
  for (int i = 0; i < 40; ++i) {
    order.navigation.turn(3, 1, false);
    order.number = static_cast<uint64_t>(i) + 1;
    painter.order(order);
    if (const auto painting = painter.take_painting()) {
      EXPECT_GT(painting->order.number, last);
      last = painting->order.number;
    }
  }
  while (last < order.number) {
    const Painting painting = next_painting();
    EXPECT_GT(painting.order.number, last);
    last = painting.order.number;
    if (last == order.number) {
      EXPECT_TRUE(painting.image.rgb == command_picture(order).rgb);
    }
  }
}

/// An order that takes seconds, and tells when its drawing begins.
class LargeOrder {
 public:
  LargeOrder() : order_(order_of(design_of(test_support::cylinder_minus_spheres(2000)))) {
    order_.size = {8000, 8000};
    order_.settings.samples = 64;
    order_.settings.technique = frontend::Technique::kCells;  // reports progress
    order_.settings.progress = [this](const char* stage, double) {
      if (std::string_view(stage) == "drawing" && !std::exchange(is_begun_, true)) {
        begun_.set_value();
      }
    };
  }
  const PaintOrder& order() const { return order_; }
  /// Waits until the drawing begins; returns false if it never does.
  bool begins() {
    return begun_.get_future().wait_for(frontend::kPatience) == std::future_status::ready;
  }

 private:
  PaintOrder order_;
  bool is_begun_ = false;  // set by the painter's thread
  std::promise<void> begun_;
};

TEST_F(PainterTest, ALargePictureIsGivenUpForANewerOrder) {
  LargeOrder large;
  Painter& painter = this->painter();
  painter.order(large.order());
  ASSERT_TRUE(large.begins());
  PaintOrder order = order_of(large.order().design);
  order.number = 2;
  painter.order(order);
  const Painting painting = next_painting();
  EXPECT_EQ(painting.order.number, 2u);
  EXPECT_TRUE(painting.image.rgb == command_picture(order).rgb);
}

TEST_F(PainterTest, EndsInTheMiddleOfAPicture) {
  LargeOrder large;
  std::atomic<int> pictures = 0;
  {
    Painter painter(1e6, [&pictures] { ++pictures; });
    painter.order(large.order());
    ASSERT_TRUE(large.begins());
  }
  EXPECT_EQ(pictures, 0) << "it was drawn to its end";
}

/// The ball from above.
class ProbeTest : public PainterTest {
 protected:
  Probe probe_of(const std::string& text, double x_px, double y_px) {
    Probe probe;
    probe.number = 7;
    probe.order = order_of(design_of(text));
    probe.order.navigation = {{Vec3(0), Vec3(0), 100}, Projection::kOrthographic};
    probe.place = {x_px, y_px};
    probe.tree = frontend::parse(text, "probed.csg");
    return probe;
  }
};

TEST_F(ProbeTest, AnswersProbesBeforeItRefines) {
  Painter& painter = this->painter();
  PaintOrder order = order_of(design_of(window_test::kBlock));
  order.settings.shading = frontend::Shading::kStudio;
  order.settings.samples = frontend::kStudioSamples;
  order.size = {400, 300};
  painter.order(order);
  next_painting();
  for (int i = 0; i < 3; ++i) {
    painter.probe(probe_of(window_test::kBlock, 5, 5));
    next_finding();
  }
  order.settings.studio.shares_light = false;
  EXPECT_TRUE(next_final().image.rgb == command_picture(order).rgb);
}

TEST_F(ProbeTest, FindsPointNormalAndLine) {
  const std::string text = "group() {\n\t" + window_test::kBall + "}\n";
  Painter& painter = this->painter();
  painter.probe(probe_of(text, 90, 55));
  const Finding finding = next_finding();
  EXPECT_EQ(finding.probe.number, 7u);
  EXPECT_TRUE(finding.is_hit);
  const double unit = 2 * 100 * std::tan(11.25 * M_PI / 180) / 120;
  EXPECT_NEAR(finding.position.x, 10 * unit, 1e-12);
  EXPECT_NEAR(finding.position.y, 5 * unit, 1e-12);
  EXPECT_NEAR(glm::length(finding.position), 10, 1e-12);
  EXPECT_GT(finding.position.z, 0);
  EXPECT_LE(glm::length(finding.normal - finding.position / 10.0), 1e-12);
  EXPECT_FALSE(finding.is_cut);
  EXPECT_EQ(finding.place.step().what, "sphere(r = 10)");
  EXPECT_EQ(finding.place.step().place.line, 2u);
  EXPECT_EQ(finding.place.step().place.column, 2u);
  EXPECT_EQ(finding.surface.kind, Surface::Kind::kCenter);
  EXPECT_NEAR(finding.surface.radius, 10, 1e-12);
}

TEST_F(ProbeTest, BesideTheModelThereIsNothing) {
  Painter& painter = this->painter();
  painter.probe(probe_of(window_test::kBall, 5, 5));
  EXPECT_FALSE(next_finding().is_hit);
}

TEST_F(ProbeTest, TheCutNamesTheLeafThatIsCut) {
  Painter& painter = this->painter();
  const std::string shell = "difference() {\n" + window_test::kBall + "sphere(r = 3);\n}\ncube(1);";
  Probe probe = probe_of(shell, 90, 60);  // at x = 3.3
  probe.order.section = {true, {0, 0, 1}, false, 1.5};
  painter.probe(probe);
  const Finding finding = next_finding();
  EXPECT_TRUE(finding.is_cut);
  EXPECT_EQ(finding.place.step().what, "sphere(r = 10)");
  EXPECT_EQ(finding.place.step().place.line, 2u);
  EXPECT_EQ(finding.surface.kind, Surface::Kind::kPlane);
  EXPECT_NEAR(finding.position.z, 1.5, 1e-12);
}

TEST_F(ProbeTest, EachIsAnsweredInTurn) {
  Painter& painter = this->painter();
  for (uint64_t number = 1; number <= 5; ++number) {
    Probe probe = probe_of(window_test::kBall, 80, 60);
    probe.number = number;
    painter.probe(probe);
  }
  for (uint64_t number = 1; number <= 5; ++number) {
    EXPECT_EQ(next_finding().probe.number, number);
  }
}

TEST_F(PainterTest, ErrorsComeInPlaceOfPictures) {
  Painter& painter = this->painter();
  // A size that even a scaled scene cannot have.
  painter.order(order_of(
      design_of(test_support::scene_of(csgcore::Op::kUnion, {csgcore::make_sphere(1e95)}))));
  const Painting failed = next_painting();
  EXPECT_THAT(failed.error, HasSubstr("error: "));
  EXPECT_TRUE(failed.image.rgb.empty());
  PaintOrder order = order_of(design_of(window_test::kBall));
  order.number = 2;
  painter.order(order);
  const Painting painting = next_painting();
  EXPECT_EQ(painting.error, "");
  EXPECT_TRUE(painting.image.rgb == command_picture(order).rgb);
}

}  // namespace
}  // namespace window
