// Tests what the report says and draws of each section.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "made_results.hpp"
#include "report.hpp"

namespace {

using made::results_of;
using made::times;
using made::whole;
using nlohmann::json;
using report::Report;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> names_of(const std::vector<report::Figure>& figures) {
  std::vector<std::string> names;
  for (const report::Figure& figure : figures) names.push_back(figure.name);
  return names;
}

TEST(Report, SaysWhatTheResultsHold) {
  const Report made = report::make_report(results_of({{"whole", whole()}}));
  const std::string& text = made.markdown;
  EXPECT_THAT(text, HasSubstr("2026-01-02 at commit 0123456789 on 2 cores"));
  EXPECT_THAT(text, HasSubstr("POV-Ray 3.7 and scadray 0.1.0"));
  EXPECT_THAT(text,
              HasSubstr("| CS100 | 101 | 1 MB | 8 (7.60–8.80) | 12 | 20 MB | 10 ms: reached |"));
  EXPECT_THAT(text, HasSubstr("| 15 ms: missed |"));
  // The bar for the time is reached, that for the memory is missed.
  EXPECT_THAT(text, HasSubstr("| 40 ms, 10 MB: missed |"));
  EXPECT_THAT(text, HasSubstr("CS grows as n^0.301 from 1,001 to 10,001"));
  EXPECT_THAT(text, HasSubstr("](whole.svg)"));
  EXPECT_THAT(text, HasSubstr("- cs1000000: no memory\n"));
  EXPECT_THAT(text, Not(HasSubstr("and more words")));
  EXPECT_THAT(names_of(made.figures), testing::ElementsAre("whole"));
}

/// A program's point at one setting: wrong pixels and the depth, or null.
json error_point(const char* series, const char* setting, double ms, json wrong, json depth) {
  return {{"series", series},
          {"setting", setting},
          {"time_ms", times(ms)},
          {"error",
           {{"wrong", std::move(wrong)},
            {"silhouette", 3},
            {"depth_worst", depth},
            {"depth_mean", depth},
            {"colour_wrong", nullptr}}}};
}

json error_level(const char* series, const char* setting, double ratio) {
  return {{"series", series},      {"setting", setting},    {"measure", "wrong"},
          {"error", 965},          {"time_ms", 10 * ratio}, {"scadray", "scadray CPU"},
          {"scadray_setting", ""}, {"scadray_error", 0},    {"scadray_ms", 10},
          {"ratio", ratio}};
}

json time_against_error() {
  return {{"picture", {{"width_px", 640}, {"height_px", 480}, {"pixels", 307'200}}},
          {"measures", {{"depth_mean", "how far off"}}},
          {"scenes",
           {{{"design", "cs1000"},
             {"points",
              {error_point("scadray CPU", "", 10, 0, 1e-16),
               error_point("OpenSCAD preview", "$fn=12", 1'000, 3'072, 0.01),
               error_point("OpenSCAD preview", "$fn=48", 4'800, 965, 0.001),
               error_point("POV-Ray", "", 1'500, 0, nullptr)}},
             {"levels",
              {error_level("OpenSCAD preview", "$fn=12", 100),
               error_level("OpenSCAD preview", "$fn=48", 480)}}}}},
          {"ratios",
           {{{"what", "OpenSCAD preview, $fn=48"},
             {"design", "cs1000"},
             {"time_ms", 4'800},
             {"scadray_ms", 10},
             {"ratio", 480},
             {"at_least", 200}},
            {{"what", "POV-Ray"},
             {"design", "cs1000"},
             {"time_ms", 150},
             {"scadray_ms", 10},
             {"ratio", 15},
             {"at_least", 25}}}},
          {"left_out", json::array()}};
}

TEST(Report, PlotsErrorsOverTimes) {
  const Report made = report::make_report(results_of({{"error", time_against_error()}}));
  ASSERT_THAT(names_of(made.figures), testing::ElementsAre("error_cs1000"));
  const report::Panel& wrong = made.figures[0].panels.at(0);
  ASSERT_EQ(wrong.series.size(), 3u);  // one per program
  EXPECT_EQ(wrong.series[1].name, "OpenSCAD preview");
  ASSERT_EQ(wrong.series[1].points.size(), 2u);
  EXPECT_EQ(wrong.series[1].points[0].x, 1'000);
  EXPECT_EQ(wrong.series[1].points[0].y, 0.01);  // a share of the picture's pixels
  EXPECT_EQ(wrong.series[0].points[0].y, 0);
  EXPECT_EQ(wrong.y.zero_at, 1e-3);  // below 965 of 307,200
  // An unknown error is not drawn.
  EXPECT_EQ(made.figures[0].panels.at(1).series.size(), 2u);
}

TEST(Report, SaysByHowMuchItIsAhead) {
  const std::string text =
      report::make_report(results_of({{"error", time_against_error()}})).markdown;
  EXPECT_THAT(text,
              HasSubstr("| OpenSCAD preview, $fn=48 | CS1000 | 4,800 | 10 | 480 | 200: reached |"));
  EXPECT_THAT(text, HasSubstr("| POV-Ray | CS1000 | 150 | 10 | 15 | 25: missed |"));
  // The worse of its two levels.
  EXPECT_THAT(text, HasSubstr("| OpenSCAD preview | 2 | CS1000 | $fn=12 | wrong | 965 | 1,000 | "
                              "scadray CPU | 0 | 10 | 100 |"));
  EXPECT_THAT(text, HasSubstr("| POV-Ray |  | 1,500 (1,425–1,650) | 0 | 3 | – | – | – |"));
  EXPECT_THAT(text, HasSubstr("- *depth mean*: how far off\n"));
}

TEST(Report, HoldsAMovedCameraAgainstEmbree) {
  json frames{{"design", "cs1000"}, {"width_px", 640}, {"height_px", 480},
              {"frames", 60},       {"turn_deg", 1},   {"threads", 2}};
  frames["programs"] = {{{"name", "scadray, tiles"},
                         {"frame_ms", times(4)},
                         {"prepare_ms", times(1)},
                         {"prepares", "lists"},
                         {"ratio", 0.6}}};
  const auto text_of = [](const json& section) {
    return report::make_report(results_of({{"frames", section}})).markdown;
  };
  EXPECT_THAT(text_of(frames), HasSubstr("| scadray, tiles | 4 (3.80–4.40) | 1 | lists | 0.600 |"));
  EXPECT_THAT(text_of(frames), Not(HasSubstr("wanted")));
  frames["ratio"] = {{"what", "the ratio"}, {"value", 0.6}, {"at_most", 0.5}};
  EXPECT_THAT(text_of(frames), HasSubstr("The ratio: 0.600 (wanted: at most 0.500, missed)."));
}

TEST(Summary, IsOneTableAndOnePlot) {
  const std::string text =
      report::make_summary(results_of({{"error", time_against_error()}, {"whole", whole()}}), "r");
  EXPECT_THAT(text, HasSubstr("2026-01-02 at commit 0123456789 on 2 cores"));
  EXPECT_THAT(text, HasSubstr("640×480"));
  EXPECT_THAT(text, HasSubstr("| CS1000 | OpenSCAD preview, $fn=48 | 4,800 | 10 | 480 |\n"));
  EXPECT_THAT(text, HasSubstr("| CS1000 | POV-Ray | 150 | 10 | 15 |\n"));
  EXPECT_THAT(text, HasSubstr("](r/error_cs1000.svg)\n"));
  EXPECT_THAT(text, Not(HasSubstr("whole.svg")));
}

TEST(Summary, LeavesOutWhatIsMissing) {
  const std::string machine = report::make_summary(results_of(json::object()), "r");
  EXPECT_THAT(machine, HasSubstr("2026-01-02"));
  EXPECT_THAT(machine, Not(HasSubstr("|")));
  EXPECT_EQ(report::make_summary(results_of({{"error", json()}}), "r"), machine);
  json other = time_against_error();
  other["scenes"][0]["design"] = "r9";
  EXPECT_THAT(report::make_summary(results_of({{"error", other}}), "r"), Not(HasSubstr(".svg")));
  other.erase("ratios");
  EXPECT_THROW(report::make_summary(results_of({{"error", other}}), "r"), std::runtime_error);
  EXPECT_THROW(report::make_summary(json::array(), "r"), std::runtime_error);
}

json frame_by_gl(const char* design, uint32_t height_px, const char* technique, double ms) {
  return {{"design", design},     {"width_px", 640},      {"height_px", height_px},
          {"leaf_primitives", 8}, {"threshold_px", 0},    {"technique", technique},
          {"frame", times(ms)},   {"traverse", times(1)}, {"draw", times(2)},
          {"read", times(3)},     {"leaves", 1'000},      {"cells_drawn", 500},
          {"draw_calls", 5},      {"wrong_pixels", 2},    {"hits", 90'000}};
}

TEST(Report, TakesTheQuickestTechniqueOfOpenGl) {
  const json gl{{"renderer", "gl: slow"},
                {"software", true},
                {"frames",
                 {frame_by_gl("cs1000", 480, "cells", 80), frame_by_gl("cs1000", 480, "tiles", 20),
                  frame_by_gl("cs1000", 1080, "tiles", 10)}}};
  const Report made = report::make_report(results_of({{"opengl", gl}}));
  EXPECT_THAT(made.markdown, HasSubstr("takes 20 ms a frame with K = 8, by tiles"));
  EXPECT_THAT(made.markdown, HasSubstr("reached).\n"));
  EXPECT_THAT(made.markdown, HasSubstr("| 2 of 90,000 |"));
  ASSERT_EQ(made.figures.size(), 1u);
  EXPECT_EQ(made.figures[0].panels.size(), 1u);  // none for cs10000, which is missing
}

/// A rule's times; also by OpenGL, if `wrong` is a number.
json rule_times(int k, double threshold_px, double ms, json wrong) {
  json rule{{"leaf_primitives", k},
            {"threshold_px", threshold_px},
            {"leaves", 1'000},
            {"S", times(ms)},
            {"cpu", {{"T_R", times(2 * ms)}, {"wrong_pixels", 0}}}};
  if (!wrong.is_null()) {
    rule["gl"] = {{"T_S", times(ms)},
                  {"T_R", times(3 * ms)},
                  {"S_R", times(4 * ms)},
                  {"draw_calls", 4},
                  {"wrong_pixels", wrong}};
  }
  return rule;
}

TEST(Report, PutsThePapersFiguresBeside) {
  const json paper_times{{"S", 1'739}, {"T_S", 964}, {"T_R", 10'776}, {"S_R", 11'243}};
  const json section{
      {"table",
       {{{"design", "cs1000"},
         {"paper", {{"C1", paper_times}, {"C2", paper_times}, {"draw_calls", 85'306}}},
         {"rules", {rule_times(2, 1, 45, 295), rule_times(8, 0, 1, nullptr)}}}}},
      {"growth",
       {{"paper_c1_t_r", {{500, 16'046}, {1'000, 34'975}}},
        {"points",
         {{{"cones", 100}, {"rules", {rule_times(2, 1, 10, 1)}}},
          {{"cones", 200}, {"rules", {rule_times(2, 1, 20, 1)}}}}},
        {"exponents", {{{"S", 1}, {"gl_T_R", 1.02}, {"cpu_T_R", nullptr}}}}}},
      {"threshold",
       {{"hits", 1'000}, {"rules", {rule_times(2, 4, 1, 100), rule_times(2, 2, 2, 10)}}}}};
  const Report made = report::make_report(results_of({{"paper", section}}));
  EXPECT_THAT(
      made.markdown,
      HasSubstr("| CS1000 | paper, C1 | 1,739 | 964 | 10,776 | 11,243 |  |  | 85,306 |  |"));
  EXPECT_THAT(made.markdown,
              HasSubstr("| CS1000 | here, K = 2, 1 pixel | 45 | 45 | 135 | 180 | 90 | "
                        "1,000 | 4 | 295 |"));
  EXPECT_THAT(made.markdown,
              HasSubstr("| CS1000 | here, K = 8 | 1 | – | – | – | 2 | 1,000 | – | – |"));
  EXPECT_THAT(made.markdown, HasSubstr("From 100 to 200 cones (figure 14) T_R grows as n^1.02 by "
                                       "OpenGL with K = 2, 1 pixel.\n"));
  EXPECT_THAT(names_of(made.figures), testing::ElementsAre("paper_growth", "paper_threshold"));
  EXPECT_EQ(made.figures[1].panels.at(0).series.at(0).points.at(0).y, 0.1);
}

TEST(Report, LeavesOutWhatIsMissing) {
  const Report nothing = report::make_report(results_of(json::object()));
  EXPECT_THAT(nothing.markdown, Not(HasSubstr("\n##")));
  EXPECT_TRUE(nothing.figures.empty());
  json sections;
  for (const report::Chapter& chapter : report::chapters()) sections[chapter.section] = json();
  EXPECT_EQ(report::make_report(results_of(sections)).markdown, nothing.markdown);
  sections["stability"] = {{"curves", json::array()}, {"left_out", {"stability: no oracle"}}};
  EXPECT_THAT(report::make_report(results_of(sections)).markdown,
              HasSubstr("- stability: no oracle"));
}

TEST(Report, NamesTheSectionThatIsNotAsItHasToBe) {
  json broken = whole();
  broken["designs"][0].erase("wall_ms");
  try {
    report::make_report(results_of({{"whole", broken}}));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("section whole: "));
  }
  EXPECT_THROW(report::make_report(json::array()), std::runtime_error);
}

}  // namespace
