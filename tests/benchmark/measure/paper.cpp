// {"left_out": [reason, …],
//  "opengl": "gl: " and GL_RENDERER; "" without,
//  "table": [{"design", "primitives", "pixels", "hits",
//             "paper": {"C1": {"S", "T_S", "T_R", "S_R"}, "C2": {…}, "draw_calls" (where said)},
//             "rules": [RULE by the paper's rule, RULE by scadray's]}, …],     table 1
//  "area":    {"design", "points": [POINT with "distance" (1: all is seen), …]},     §4.1
//  "in_view": {"design", "points": [POINT with "pan" (of the picture's width), …]},  §4.1
//  "depth":   {"design", "points": [POINT with "copies" (behind each other), …]},    §4.1
//  "growth":  {"paper_c1_t_r": [[cones, ms], …],
//              "points": [{"design", "cones", "rules": [RULE, RULE]}, …],
//              "exponents": [{"S", "gl_T_R", "cpu_T_R"} of the rules in their order]},  figure 14
//  "threshold": {"design", "hits", "rules": [RULE with K = 2 by the threshold, …]},     figure 3
//  "leaf_primitives": {"design", "hits", "rules": [RULE without a threshold by K, …]}}
// RULE is what `scadray bench --json` says of a rule (frontend/bench/README.md): times as
// summaries in ms, "gl" only where there is OpenGL.
// POINT: {"hits": pixels that show it, "cells", "cells_in_view", "cells_per_pixel" (the mean depth
// complexity), "rule": RULE}, by scadray's rule, whose cells do not depend on the view.
#include "paper_figures.hpp"
#include "paper_sweeps.hpp"

namespace measure {
namespace {

using nlohmann::json;

json json_of(const PaperTimes& times) {
  return {{"S", times.s}, {"T_S", times.t_s}, {"T_R", times.t_r}, {"S_R", times.s_r}};
}

const std::vector<bench::Rule> kBoth{bench::kPaperRule, bench::Rule{}};

json measure_table(PaperMeasurer& measurer) {
  json rows = json::array();
  for (const PaperRow& row : kPaperTable) {
    if (measurer.settings().quick && row.design != std::string("r9")) continue;
    const Subject subject = read_subject(row.design, measurer.settings());
    json entry = measurer.rules(subject, default_view(subject, camera_options()), kBoth);
    entry["paper"] = {{"C1", json_of(row.c1)}, {"C2", json_of(row.c2)}};
    if (row.draw_calls > 0) entry["paper"]["draw_calls"] = row.draw_calls;
    rows.push_back(std::move(entry));
  }
  return rows;
}

json measure_growth(PaperMeasurer& measurer) {
  json points = json::array();
  for (const uint32_t cones : measurer.some<uint32_t>({100, 200, 500, 1000})) {
    const Subject subject = read_subject("cc" + std::to_string(cones), measurer.settings());
    json entry = measurer.rules(subject, default_view(subject, camera_options()), kBoth);
    entry["cones"] = cones;
    points.push_back(std::move(entry));
  }
  json exponents = json::array();
  for (size_t rule = 0; rule < kBoth.size(); ++rule) {
    exponents.push_back({{"S", growth_exponent(points, rule, "/S")},
                         {"gl_T_R", growth_exponent(points, rule, "/gl/T_R")},
                         {"cpu_T_R", growth_exponent(points, rule, "/cpu/T_R")}});
  }
  json paper = json::array();
  for (const PaperPoint& point : kPaperGrowth) paper.push_back({point.cones, point.c1_t_r});
  return {{"paper_c1_t_r", paper}, {"points", points}, {"exponents", exponents}};
}

json measure_rules(PaperMeasurer& measurer, const std::vector<bench::Rule>& rules) {
  const Subject subject =
      read_subject(measurer.settings().quick ? "cs100" : "cs1000", measurer.settings());
  return measurer.rules(subject, default_view(subject, camera_options()), rules);
}

json measure_thresholds(PaperMeasurer& measurer) {
  std::vector<bench::Rule> rules;
  for (const double threshold_px : measurer.some<double>({4, 2, 1, 0.5, 0.25})) {
    rules.push_back({2, threshold_px});
  }
  return measure_rules(measurer, rules);
}

json measure_leaf_primitives(PaperMeasurer& measurer) {
  std::vector<bench::Rule> rules;
  for (const uint32_t k : measurer.some<uint32_t>({16, 12, 8, 6, 4, 3, 2})) {
    rules.push_back({k, 0});
  }
  return measure_rules(measurer, rules);
}

}  // namespace

json measure_paper(const Settings& settings) {
  PaperMeasurer measurer(settings);
  json result;
  result["table"] = measure_table(measurer);
  measurer.take_fewer_samples();
  result["growth"] = measure_growth(measurer);
  result["threshold"] = measure_thresholds(measurer);
  result["leaf_primitives"] = measure_leaf_primitives(measurer);
  result["area"] = sweep_area(measurer);
  result["in_view"] = sweep_cells_in_view(measurer);
  result["depth"] = sweep_depth(measurer);
  result["opengl"] = measurer.opengl();
  result["left_out"] = measurer.left_out();
  return result;
}

}  // namespace measure
