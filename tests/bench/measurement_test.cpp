// Tests which times of a scene are measured, and what they include.
#include "bench/measurement.hpp"

#include <gmock/gmock.h>

#include <optional>

#include "frontend/camera.hpp"
#include "support/models.hpp"

namespace bench {
namespace {

using frontend::RendererKind;
using testing::HasSubstr;
using testing::Not;

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

Json measure_few(const csgcore::Scene& scene, const Settings& settings) {
  return measure(std::make_shared<const csgcore::Scene>(scene), views(), settings,
                 [](const std::string&) {});
}

/// The times have the right order and count.
void expect_sound(const Json& times) {
  EXPECT_EQ(times["count"], 3);
  EXPECT_GT(times["least"], 0);
  EXPECT_LE(times["least"], times["quartiles"][0]);
  EXPECT_LE(times["quartiles"][0], times["median"]);
  EXPECT_LE(times["median"], times["quartiles"][1]);
}

TEST(Measurement, OfTheCpu) {
  const Json result = measure_few(test_support::cylinder_minus_spheres(60), few());
  EXPECT_EQ(result["primitives"], 61);
  EXPECT_EQ(result["pixels"], 120 * 90);
  EXPECT_GT(result["hits"], 1000);
  EXPECT_LT(result["hits"], result["pixels"]);
  EXPECT_TRUE(result["left_out"].empty() && result["wrong"].empty()) << result;
  ASSERT_EQ(result["frames"].size(), 2u);
  EXPECT_EQ(result["frames"][0]["technique"], "tiles");
  EXPECT_EQ(result["frames"][1]["technique"], "cells");
  EXPECT_FALSE(result["frames"][0].contains("first_subdivide"));
  EXPECT_LT(result["frames"][1]["first_subdivide"]["least"], result["frames"][1]["first"]["least"]);
  for (const Json& times : result["frames"]) {
    EXPECT_EQ(times["renderer"], "cpu");
    EXPECT_EQ(times["wrong_pixels"], 0);
    EXPECT_FALSE(times.contains("context") || times.contains("first_shaders"));
    expect_sound(times["first"]);
    expect_sound(times["steady"]);
  }
}

TEST(Measurement, ReportsCellsThatWereGivenUp) {
  Json result = measure_few(test_support::cylinder_minus_spheres(1), few());
  result["rules"][0]["leaves"] = 1234567;
  EXPECT_EQ(result["rules"][0]["leaves_given_up"], 0);
  EXPECT_THAT(table_of("x.csg", result), Not(HasSubstr("given up")));
  EXPECT_THAT(table_of("x.csg", result), HasSubstr(": 2 primitives, "));
  result["primitives"] = 1;
  EXPECT_THAT(table_of("x.csg", result), HasSubstr(": 1 primitive, "));
  result["rules"][0]["leaves_given_up"] = 23456;
  EXPECT_THAT(table_of("x.csg", result), HasSubstr("1,234,567 leaves, 23,456 of them given up"));
}

TEST(Measurement, OfThePapersTimes) {
  const Json rules = measure_few(test_support::cylinder_minus_spheres(60), few())["rules"];
  ASSERT_EQ(rules.size(), 2u);
  const Json &own = rules[0], &paper = rules[1];
  EXPECT_EQ(own["leaf_primitives"], 8);
  EXPECT_EQ(own["leaves_dropped"], 0);
  EXPECT_EQ(own["cpu"]["wrong_pixels"], 0);
  EXPECT_EQ(paper["leaf_primitives"], 2);
  EXPECT_EQ(paper["threshold_px"], 1);
  EXPECT_GT(paper["leaves"], own["leaves"]);
  EXPECT_GT(paper["leaves_dropped"], 0);
  EXPECT_GT(paper["cpu"]["wrong_pixels"], 0);  // where cells were dropped
  for (const Json& times : rules) {
    expect_sound(times["S"]);
    expect_sound(times["cpu"]["T_R"]);
    EXPECT_FALSE(times.contains("gl"));
  }
  EXPECT_GT(paper["S"]["least"], own["S"]["least"]);
}

TEST(Measurement, AnEmptyModelIsNotMeasured) {
  const Json result = measure_few({}, few(RendererKind::kAuto));
  EXPECT_EQ(result["primitives"], 0);
  for (const char* list : {"frames", "rules", "left_out"}) EXPECT_TRUE(result[list].empty());
}

/// Returns why OpenGL is not available; nothing if it is.
std::optional<std::string> why_no_gl() {
  Settings settings = few(RendererKind::kAuto);
  settings.rules = {Rule{}};
  const Json result = measure_few(test_support::cylinder_minus_spheres(1), settings);
  if (result["left_out"].empty()) return std::nullopt;
  return result["left_out"][0].get<std::string>();
}

TEST(Measurement, OfOpenGlAlone) {
  if (const auto reason = why_no_gl()) GTEST_SKIP() << *reason;
  const Json result = measure_few(test_support::cylinder_minus_spheres(60), few(RendererKind::kGl));
  EXPECT_TRUE(result["wrong"].empty()) << result;
  for (const Json& times : result["frames"]) {
    EXPECT_THAT(times["renderer"].get<std::string>(), testing::StartsWith("gl: "));
    for (const char* key : {"context", "first", "steady"}) expect_sound(times[key]);
    EXPECT_LT(times["first_shaders"]["least"], times["first"]["quartiles"][1]);
  }
  ASSERT_EQ(result["rules"].size(), 2u);
  for (const Json& times : result["rules"]) {
    EXPECT_FALSE(times.contains("cpu"));
    expect_sound(times["S"]);
    for (const char* key : {"T_S", "T_R", "S_R"}) expect_sound(times["gl"][key]);
    EXPECT_LT(times["gl"]["T_S"]["least"], times["gl"]["T_R"]["quartiles"][1]);
    EXPECT_GT(times["gl"]["draw_calls"], 0);
    EXPECT_GT(times["gl"]["cells_drawn"], times["gl"]["draw_calls"]);
  }
  EXPECT_GT(result["rules"][1]["gl"]["wrong_pixels"], 0);
}

// A wall thinner than OpenGL draws, and thicker than the CPU leaves out.
TEST(Measurement, AWrongPictureHasNoTimes) {
  if (const auto reason = why_no_gl()) GTEST_SKIP() << *reason;
  const csgcore::Scene scene =
      test_support::scene_of(csgcore::Op::kUnion, {csgcore::make_frustum(0, 4e-6, 10, 10)});
  const Json result = measure_few(scene, few(RendererKind::kAuto));
  EXPECT_EQ(result["frames"].size(), 2u);
  ASSERT_EQ(result["rules"].size(), 2u);
  EXPECT_FALSE(result["rules"][0].contains("gl"));
  EXPECT_EQ(result["wrong"].size(), 3u);  // the frames of both techniques, and the paper's times
  for (const Json& wrong : result["wrong"]) {
    EXPECT_THAT(wrong.get<std::string>(),
                testing::MatchesRegex("gl, .*: [0-9]+ of 10800 pixels show .*"));
  }
}

}  // namespace
}  // namespace bench
