// Tests which times of a scene are measured, and what they include.
#include "bench/measurement.hpp"

#include <gmock/gmock.h>

#include "bench/report.hpp"
#include "frontend/camera.hpp"
#include "support/models.hpp"

namespace bench {
namespace {

using frontend::RendererKind;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<csgcore::View> views(int count = 4) {
  frontend::CameraOptions options;
  options.width_px = 120;
  options.height_px = 90;
  std::vector<csgcore::View> result;
  for (int i = 0; i < count; ++i) {
    result.push_back(make_view({csgcore::Vec3(0), {55, 0, 25.0 + i}, 90}, options));
  }
  return result;
}

Settings few(RendererKind renderer = RendererKind::kCpu) {
  Settings settings;
  settings.renderer = renderer;
  settings.repetitions = {3, 3, 0};
  return settings;
}

Result measure_few(const csgcore::Scene& scene, const Settings& settings) {
  return measure(std::make_shared<const csgcore::Scene>(scene), views(), settings,
                 [](const std::string&) {});
}

void expect_sound(const Summary& times) {
  EXPECT_EQ(times.count, 3u);
  EXPECT_GT(times.least, 0);
  EXPECT_LE(times.least, times.lower_quartile);
  EXPECT_LE(times.lower_quartile, times.median);
  EXPECT_LE(times.median, times.upper_quartile);
}

TEST(Measurement, OfTheCpu) {
  const Result result = measure_few(test_support::cylinder_minus_spheres(60), few());
  EXPECT_EQ(result.primitives, 61u);
  EXPECT_EQ(result.pixels, 120u * 90);
  EXPECT_GT(result.hits, 1000u);
  EXPECT_LT(result.hits, result.pixels);
  EXPECT_THAT(result.left_out, IsEmpty());
  EXPECT_THAT(result.wrong, IsEmpty());
  ASSERT_EQ(result.frames.size(), 2u);
  EXPECT_EQ(result.frames[0].technique, "tiles");
  EXPECT_EQ(result.frames[1].technique, "cells");
  EXPECT_FALSE(result.frames[0].subdivide);
  ASSERT_TRUE(result.frames[1].subdivide);
  EXPECT_LT(result.frames[1].subdivide->least, result.frames[1].first.least);
  for (const FrameTimes& times : result.frames) {
    EXPECT_EQ(times.renderer, "cpu");
    EXPECT_EQ(times.wrong_pixels, 0u);
    EXPECT_FALSE(times.context || times.shaders);
    expect_sound(times.first);
    expect_sound(times.steady);
  }
}

TEST(Measurement, ReportsCellsThatWereGivenUp) {
  RuleTimes times;
  times.rule = kPaperRule;
  times.cells.leaves = 1234567;
  Result result;
  result.rules = {times};
  EXPECT_THAT(table_of("x.csg", result), testing::Not(testing::HasSubstr("given up")));
  EXPECT_EQ(json_of(times)["leaves_given_up"], 0);
  EXPECT_THAT(table_of("x.csg", result), testing::HasSubstr(": 0 primitives, "));
  result.primitives = 1;
  EXPECT_THAT(table_of("x.csg", result), testing::HasSubstr(": 1 primitive, "));
  result.rules[0].cells.leaves_given_up = 23456;
  EXPECT_THAT(table_of("x.csg", result),
              testing::HasSubstr("1,234,567 leaves, 23,456 of them given up"));
  EXPECT_EQ(json_of(result.rules[0])["leaves_given_up"], 23456);
}

TEST(Measurement, OfThePapersTimes) {
  const Result result = measure_few(test_support::cylinder_minus_spheres(60), few());
  ASSERT_EQ(result.rules.size(), 2u);
  const RuleTimes& own = result.rules[0];
  const RuleTimes& paper = result.rules[1];
  EXPECT_EQ(own.rule.leaf_primitives, 8u);
  EXPECT_EQ(own.cells.leaves_dropped, 0u);
  EXPECT_EQ(own.cpu_wrong_pixels, 0u);
  EXPECT_EQ(paper.rule.leaf_primitives, 2u);
  EXPECT_EQ(paper.rule.threshold_px, 1);
  EXPECT_GT(paper.cells.leaves, own.cells.leaves);
  EXPECT_GT(paper.cells.leaves_dropped, 0u);
  EXPECT_GT(paper.cpu_wrong_pixels, 0u);  // where cells were dropped
  for (const RuleTimes& times : result.rules) {
    expect_sound(times.subdivide);
    ASSERT_TRUE(times.cpu_render);
    expect_sound(*times.cpu_render);
    EXPECT_FALSE(times.gl);
  }
  EXPECT_GT(paper.subdivide.least, own.subdivide.least);
}

TEST(Measurement, AnEmptyModelIsNotMeasured) {
  const Result result = measure_few({}, few(RendererKind::kAuto));
  EXPECT_EQ(result.primitives, 0u);
  EXPECT_THAT(result.frames, IsEmpty());
  EXPECT_THAT(result.rules, IsEmpty());
  EXPECT_THAT(result.left_out, IsEmpty());
}

/// Returns why OpenGL is not available; nothing if it is.
std::optional<std::string> why_no_gl() {
  Settings settings = few(RendererKind::kAuto);
  settings.rules = {Rule{}};
  const Result result = measure_few(test_support::cylinder_minus_spheres(1), settings);
  return result.left_out.empty() ? std::nullopt : std::optional(result.left_out[0]);
}

TEST(Measurement, OfOpenGlAlone) {
  if (const auto reason = why_no_gl()) GTEST_SKIP() << *reason;
  const Result result =
      measure_few(test_support::cylinder_minus_spheres(60), few(RendererKind::kGl));
  EXPECT_THAT(result.wrong, IsEmpty());
  for (const FrameTimes& times : result.frames) {
    EXPECT_THAT(times.renderer, testing::StartsWith("gl: "));
    ASSERT_TRUE(times.context && times.shaders);
    expect_sound(*times.context);
    expect_sound(times.first);
    expect_sound(times.steady);
    EXPECT_LT(times.shaders->least, times.first.upper_quartile);
  }
  ASSERT_EQ(result.rules.size(), 2u);
  for (const RuleTimes& times : result.rules) {
    EXPECT_FALSE(times.cpu_render);
    expect_sound(times.subdivide);
    ASSERT_TRUE(times.gl);
    expect_sound(times.gl->pass);
    expect_sound(times.gl->render);
    expect_sound(times.gl->render_while_subdividing);
    EXPECT_LT(times.gl->pass.least, times.gl->render.upper_quartile);
    EXPECT_GT(times.gl->draw_calls, 0u);
    EXPECT_GT(times.gl->cells_drawn, times.gl->draw_calls);
  }
  EXPECT_GT(result.rules[1].gl->wrong_pixels, 0u);
}

// A wall thinner than OpenGL draws, and thicker than the CPU leaves out.
TEST(Measurement, AWrongPictureHasNoTimes) {
  if (const auto reason = why_no_gl()) GTEST_SKIP() << *reason;
  const csgcore::Scene scene =
      test_support::scene_of(csgcore::Op::kUnion, {csgcore::make_frustum(0, 4e-6, 10, 10)});
  const Result result = measure_few(scene, few(RendererKind::kAuto));
  EXPECT_EQ(result.frames.size(), 2u);
  ASSERT_EQ(result.rules.size(), 2u);
  EXPECT_FALSE(result.rules[0].gl);
  EXPECT_THAT(result.wrong,
              testing::Each(testing::MatchesRegex("gl, .*: [0-9]+ of 10800 pixels show .*")));
  EXPECT_EQ(result.wrong.size(), 3u);  // the frames of both techniques, and the paper's times
}

}  // namespace
}  // namespace bench
