// Tests drawing an edited design again: the picture equals one that is drawn anew.
#include <gmock/gmock.h>

#include <optional>

#include "edited_scenes.hpp"
#include "frontend/camera.hpp"
#include "frontend/error.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "frontend/render.hpp"
#include "frontend/render_settings.hpp"
#include "frontend/scene_renderer.hpp"
#include "support/full_run.hpp"
#include "support/models.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using csgcore::Scene;
using csgcore::checks::Design;

constexpr uint32_t kSide_px = 96;

csgcore::View view_of(const Scene& scene, csgcore::Projection projection) {
  csgcore::Box box;
  for (const csgcore::Primitive& primitive : scene.primitives) {
    box.merge(primitive.local_to_world.translation);
  }
  CameraOptions options;
  options.projection = projection;
  options.width_px = options.height_px = kSide_px;
  box.merge(box.max + 1.0);
  return make_view(choose_camera(options, box), options);
}

struct Way {
  RendererKind renderer;
  Technique technique;
};

class Redrawn : public testing::TestWithParam<Way> {
 protected:
  Redrawn() {
    settings_.scheme = color_schemes().front();
    settings_.renderer = GetParam().renderer;
    settings_.technique = GetParam().technique;
    settings_.measured_channels = true;
  }

  /// Returns false if there is no OpenGL.
  bool can_draw() {
    try {
      load(csgcore::checks::framed_tree(2, 1));
      redraw(view_of(*scene_, csgcore::Projection::kPerspective));
      return true;
    } catch (const Error&) {
      return false;
    }
  }

  void load(Scene scene) {
    scene_ = std::make_shared<const Scene>(std::move(scene));
    renderer_->load(scene_);
  }

  Image redraw(const csgcore::View& view) { return renderer_->redraw(view, settings_, stats_); }

  /// Keeps a picture, to be compared at the end: OpenGL has one context at a time here.
  void expect_drawn_anew(Image image, const csgcore::View& view) {
    shown_.push_back({scene_, view, settings_, std::move(image)});
  }

  void TearDown() override {
    renderer_.reset();
    for (const Shown& shown : shown_) {
      SCOPED_TRACE("picture " + std::to_string(&shown - shown_.data()));
      RenderStats stats;
      const Image anew = render(*shown.scene, shown.view, shown.settings, stats);
      EXPECT_EQ(shown.image.rgb, anew.rgb);
      EXPECT_EQ(shown.image.z, anew.z);
      EXPECT_EQ(shown.image.id, anew.id);
      EXPECT_EQ(shown.image.normal, anew.normal);
    }
  }

  struct Shown {
    std::shared_ptr<const Scene> scene;
    csgcore::View view;
    RenderSettings settings;
    Image image;
  };

  RenderSettings settings_;
  std::shared_ptr<const Scene> scene_;
  std::optional<SceneRenderer> renderer_{std::in_place};
  std::vector<Shown> shown_;
  RenderStats stats_;
};

TEST_P(Redrawn, EqualsThePictureDrawnAnew) {
  if (!can_draw()) GTEST_SKIP() << "no OpenGL";
  constexpr uint32_t kEdits = 6, kPrimitives = 24;
  // By OpenGL on the CPU one takes half a minute, and a sanitizer sees little more of a second one.
  const bool is_cpu = GetParam().renderer == RendererKind::kCpu;
  const uint32_t trees = is_cpu ? 4 : std::max(test_support::sample_size(4) / 2, 1u);
  uint64_t least_traced = kSide_px * kSide_px;
  for (uint32_t seed = 0; seed < trees; ++seed) {
    std::mt19937 random(seed);
    Design design(csgcore::checks::framed_tree(kPrimitives, seed));
    settings_.samples = seed % 2 == 0 ? 1 : 4;
    const auto projection =
        2 * seed < trees ? csgcore::Projection::kPerspective : csgcore::Projection::kOrthographic;
    load(design.scene());
    const csgcore::View view = view_of(*scene_, projection);
    expect_drawn_anew(redraw(view), view);
    for (uint32_t edit = 0; edit < kEdits; ++edit) {
      design.edit(random);
      load(design.scene());
      if (edit == 2) continue;  // two saves between two pictures
      expect_drawn_anew(redraw(view), view);
      EXPECT_EQ(stats_.edit.pixels, kSide_px * kSide_px);
      least_traced = std::min(least_traced, stats_.edit.pixels_traced);
    }
  }
  if (is_cpu) {
    EXPECT_LT(least_traced, kSide_px * kSide_px / 4);
  }
}

TEST_P(Redrawn, AnEditedHullEqualsThePictureDrawnAnew) {
  if (!can_draw()) GTEST_SKIP() << "no OpenGL";
  const auto scene_of = [](const std::string& radius, const std::string& size) {
    const std::string text = "difference() { hull() { sphere(3); cube([8, 2, 2]); sphere(" +
                             radius + "); } cylinder(h = 9, r = 1); } minkowski() { cube([" + size +
                             ", 9, 1]); sphere(0.5); }";
    return import_design(parse(text, "a.csg")).scene;
  };
  load(scene_of("4", "1"));
  const csgcore::View view = view_of(*scene_, csgcore::Projection::kPerspective);
  expect_drawn_anew(redraw(view), view);
  load(scene_of("5", "1"));
  expect_drawn_anew(redraw(view), view);
  load(scene_of("5", "2"));
  expect_drawn_anew(redraw(view), view);
}

TEST_P(Redrawn, AnotherViewOrLookIsDrawnWhole) {
  if (!can_draw()) GTEST_SKIP() << "no OpenGL";
  load(csgcore::checks::framed_tree(12, 5));
  csgcore::View view = view_of(*scene_, csgcore::Projection::kPerspective);
  redraw(view);
  view.eye += 0.1 * view.right;
  expect_drawn_anew(redraw(view), view);
  settings_.shading = Shading::kPhong;
  expect_drawn_anew(redraw(view), view);
  settings_.scheme = color_schemes().back();
  expect_drawn_anew(redraw(view), view);
}

TEST_P(Redrawn, WhatTheSaveLeftAloneIsNotDrawn) {
  if (GetParam().renderer == RendererKind::kGl) GTEST_SKIP() << "OpenGL draws whole pictures";
  load(csgcore::checks::framed_tree(12, 5));
  const csgcore::View view = view_of(*scene_, csgcore::Projection::kPerspective);
  const Image first = redraw(view);
  load(Scene(*scene_));
  EXPECT_EQ(redraw(view).rgb, first.rgb);
  EXPECT_EQ(stats_.edit.primitives_changed, 0u);
  EXPECT_EQ(stats_.edit.pixels_traced, 0u);
  EXPECT_EQ(stats_.edit.cells_made, 0u);
}

TEST_P(Redrawn, ASizeThatComesAndGoesIsNoEdit) {
  if (!can_draw()) GTEST_SKIP() << "no OpenGL";
  const auto bitten = [](double size, double bite) {
    csgcore::Affine aside;
    aside.translation = {0, 0, size};
    return test_support::scene_of(
        csgcore::Op::kDifference,
        {csgcore::make_sphere(size), csgcore::make_sphere(bite * size, aside)});
  };
  csgcore::View view;
  view.eye = {0, 0, 4};
  view.half_height = 0.5;
  view.width_px = view.height_px = kSide_px;
  load(bitten(1, 0.5));
  redraw(view);
  load(bitten(1, 0.5));      // followed, but not drawn
  load(bitten(1e-30, 0.5));  // scaled
  load(bitten(1, 0.7));
  expect_drawn_anew(redraw(view), view);
}

TEST_P(Redrawn, AStoppedPictureCountsAsNone) {
  if (GetParam().renderer == RendererKind::kGl) GTEST_SKIP() << "OpenGL is not stopped";
  load(csgcore::checks::framed_tree(12, 5));
  const csgcore::View view = view_of(*scene_, csgcore::Projection::kPerspective);
  std::stop_source stopped;
  stopped.request_stop();
  settings_.stop = stopped.get_token();
  redraw(view);
  settings_.stop = {};
  expect_drawn_anew(redraw(view), view);
  EXPECT_EQ(stats_.edit.pixels_traced, stats_.edit.pixels);
}

TEST_P(Redrawn, TranslucentPartsAreDrawnAnew) {
  if (!can_draw()) GTEST_SKIP() << "no OpenGL";
  Scene scene = csgcore::checks::framed_tree(12, 5);
  csgcore::CsgTreeBuilder part;
  part.primitive(1);
  scene.layers = {{csgcore::Layer::Kind::kHighlight, true, part.finish()}};
  load(scene);
  const csgcore::View view = view_of(*scene_, csgcore::Projection::kPerspective);
  redraw(view);
  scene.layers.clear();
  load(scene);
  expect_drawn_anew(redraw(view), view);
}

TEST_P(Redrawn, APictureFromWithinALeafIsDrawnAnew) {
  if (!can_draw()) GTEST_SKIP() << "no OpenGL";
  const auto balls = [](double radius, double x) {
    csgcore::Affine aside;
    aside.translation = {x, 0, 0};
    return test_support::scene_of(csgcore::Op::kUnion,
                                  {csgcore::make_sphere(radius), csgcore::make_sphere(0.5, aside)});
  };
  csgcore::View view;
  view.eye = {0, 0, 2};
  view.half_height = 0.5;
  view.width_px = view.height_px = kSide_px;
  load(balls(3, 0));
  expect_drawn_anew(redraw(view), view);
  load(balls(3, 0.5));
  expect_drawn_anew(redraw(view), view);
  load(balls(1, 0.5));  // the eye lies outside
  expect_drawn_anew(redraw(view), view);
  load(balls(3, 0.5));
  expect_drawn_anew(redraw(view), view);
}

TEST_P(Redrawn, ASizeBeyondFloatsIsScaledAndFollowed) {
  if (!can_draw()) GTEST_SKIP() << "no OpenGL";
  const double size = 1e-30;
  csgcore::Affine aside;
  const auto bitten = [&](double bite) {
    return test_support::scene_of(csgcore::Op::kDifference,
                                  {csgcore::make_sphere(size), csgcore::make_sphere(bite, aside)});
  };
  aside.translation = {0, 0, size};
  csgcore::View view;
  view.eye = {0, 0, 4 * size};
  view.half_height = 0.5;
  view.width_px = view.height_px = kSide_px;
  load(bitten(0.5 * size));
  expect_drawn_anew(redraw(view), view);
  load(bitten(0.25 * size));
  expect_drawn_anew(redraw(view), view);
}

std::string name_of(const testing::TestParamInfo<Way>& way) {
  const std::string renderer = way.param.renderer == RendererKind::kGl ? "Gl" : "";
  return renderer + (way.param.technique == Technique::kTiles ? "Tiles" : "Cells");
}

INSTANTIATE_TEST_SUITE_P(, Redrawn,
                         testing::Values(Way{RendererKind::kCpu, Technique::kTiles},
                                         Way{RendererKind::kCpu, Technique::kCells},
                                         Way{RendererKind::kGl, Technique::kCells},
                                         Way{RendererKind::kGl, Technique::kTiles}),
                         name_of);

}  // namespace
}  // namespace frontend
