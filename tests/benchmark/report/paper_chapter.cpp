#include "report.hpp"
#include "text.hpp"

namespace report {
namespace {

using nlohmann::json;

/// Returns "paper's, 1 pixel" or "K = 8".
std::string title_of_rule(const json& rule) {
  const double threshold_px = rule.at("threshold_px");
  const std::string k = "K = " + number(rule.at("leaf_primitives"));
  if (threshold_px == 0) return k;
  return k + ", " + number(threshold_px) + (threshold_px == 1 ? " pixel" : " pixels");
}

bool has(const json& rule, const char* renderer, const char* time) {
  return rule.contains(renderer) && rule.at(renderer).contains(time);
}

std::string cell(const json& rule, const char* renderer, const char* time) {
  return has(rule, renderer, time) ? number(median(rule.at(renderer).at(time))) : "–";
}

void add_paper_row(Table& table, const std::string& design, const json& paper, const char* machine,
                   const char* title) {
  const json& times = paper.at(machine);
  table.add({design, title, number(times.at("S")), number(times.at("T_S")), number(times.at("T_R")),
             number(times.at("S_R")), "", "",
             paper.contains("draw_calls") ? whole_number(paper.at("draw_calls")) : "", ""});
}

void write_table(const json& rows, Report& report) {
  report.text(
      "The paper is Romeiro, Velho, de Figueiredo, \"Hardware-assisted Rendering of CSG Models\". "
      "Its "
      "table 1, 640×480, in ms: S subdivides, T_S traverses and passes the parameters, T_R "
      "traverses and renders, S_R renders while subdividing. The paper's rule is at most 2 "
      "primitives in a cell and a threshold of 1 pixel. C1 is the paper's Pentium-M of "
      "1.4 GHz with a GeForce FX Go5200, C2 its Athlon 64 3800+ with a GeForce 6800 GT.");
  Table table({"design", "measured", "S", "T_S", "T_R", "S_R", "T_R by the CPU", "leaf cells",
               "draw calls", "wrong pixels, OpenGL"});
  for (const json& row : rows) {
    const std::string design = design_title(row.at("design"));
    if (row.contains("paper")) {
      add_paper_row(table, design, row.at("paper"), "C1", "paper, C1");
      add_paper_row(table, design, row.at("paper"), "C2", "paper, C2");
    }
    for (const json& rule : row.at("rules")) {
      const bool has_gl = rule.contains("gl");
      table.add({design, "here, " + title_of_rule(rule), number(median(rule.at("S"))),
                 cell(rule, "gl", "T_S"), cell(rule, "gl", "T_R"), cell(rule, "gl", "S_R"),
                 cell(rule, "cpu", "T_R"), whole_number(rule.at("leaves")),
                 has_gl ? whole_number(rule.at("gl").at("draw_calls")) : "–",
                 has_gl ? whole_number(rule.at("gl").at("wrong_pixels")) : "–"});
    }
  }
  report.table(table);
}

struct Renderer {
  const char* key;
  const char* name;
};
constexpr Renderer kRenderers[] = {{"gl", "OpenGL"}, {"cpu", "CPU"}};

/// Plots T_R of each renderer over the points' values at a key.
Panel dependence(const json& sweep, const char* key, const char* title, const char* axis) {
  Panel panel{title, {axis, false}, {"T_R in ms", false}, {}};
  for (const Renderer& renderer : kRenderers) {
    Series series{renderer.name, {}};
    for (const json& point : sweep.at("points")) {
      if (!has(point.at("rule"), renderer.key, "T_R")) continue;
      series.points.push_back(
          summary_point(point.at(key), point.at("rule").at(renderer.key).at("T_R")));
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

void write_dependences(const json& section, Report& report) {
  Figure figure{"paper_dependence", {}};
  const auto add = [&](const char* name, const char* key, const char* title, const char* axis) {
    if (section.contains(name)) {
      figure.panels.push_back(dependence(section.at(name), key, title, axis));
    }
  };
  add("area", "hits", "The covered area", "pixels that show it");
  add("in_view", "cells_in_view", "The cells in view", "cells in view");
  add("depth", "cells_per_pixel", "The depth complexity", "cells that a ray passes");
  if (figure.panels.empty()) return;
  report.text(
      "What T_R depends on (the paper's §4.1): the same cells cover fewer pixels as the camera "
      "goes "
      "back; fewer cells are in view as it goes aside; and copies of the design stand behind it on "
      "the same pixels.");
  report.figure(std::move(figure), "T_R over area, cells in view and depth complexity");
}

void write_growth_of_models(const json& growth, Report& report) {
  Panel panel{"Figure 14: CC100 to CC1000", {"cones"}, {"T_R in ms"}, {}};
  Series paper{"paper, C1", {}};
  for (const json& point : growth.at("paper_c1_t_r")) {
    paper.points.push_back(report::point(point.at(0), point.at(1).get<double>()));
  }
  const json& points = growth.at("points");
  std::vector<std::string> sentences;
  const size_t rules = points.empty() ? 0 : points.at(0).at("rules").size();
  for (size_t i = 0; i < rules; ++i) {
    const std::string rule = title_of_rule(points.at(0).at("rules").at(i));
    for (const Renderer& renderer : kRenderers) {
      Series series{std::string(renderer.name) + ", " + rule, {}};
      for (const json& point : points) {
        const json& of_rule = point.at("rules").at(i);
        if (!has(of_rule, renderer.key, "T_R")) continue;
        series.points.push_back(
            summary_point(point.at("cones"), of_rule.at(renderer.key).at("T_R")));
      }
      panel.series.push_back(std::move(series));
      const json exponents = growth.at("exponents").at(i);
      const json exponent = exponents.value(std::string(renderer.key) + "_T_R", json());
      if (!exponent.is_null()) {
        sentences.push_back("n^" + number(exponent) + " by " + renderer.name + " with " + rule);
      }
    }
  }
  panel.series.push_back(std::move(paper));
  if (!sentences.empty()) {
    report.text("From " + whole_number(points.front().at("cones")) + " to " +
                whole_number(points.back().at("cones")) + " cones (figure 14) T_R grows as " +
                listed(sentences) + ".");
  }
  report.figure({"paper_growth", {panel}}, "Figure 14: T_R over the number of cones");
}

/// Plots wrong pixels and times over the parameter of a rule.
void write_sweep(const json& sweep, const char* key, const char* axis, const std::string& name,
                 const std::string& title, Report& report) {
  const json& rules = sweep.at("rules");
  if (rules.empty()) return;
  const double hits = sweep.at("hits");
  Panel wrong{title + ": wrong pixels", {axis}, {"share of the hits"}, {}};
  // Half of one pixel and less counts as none.
  wrong.y.zero_at = 1e-6;
  Panel times{title + ": times", {axis}, {"time in ms"}, {}};
  Series subdivide{"subdivide", {}};
  for (const json& rule : rules) {
    subdivide.points.push_back(summary_point(rule.at(key), rule.at("S")));
  }
  times.series.push_back(std::move(subdivide));
  for (const Renderer& renderer : kRenderers) {
    Series errors{std::string(renderer.name) + ", T_R", {}}, render = errors;
    for (const json& rule : rules) {
      if (!has(rule, renderer.key, "T_R")) continue;
      const json& drawn = rule.at(renderer.key);
      errors.points.push_back(point(rule.at(key), drawn.at("wrong_pixels").get<double>() / hits));
      render.points.push_back(summary_point(rule.at(key), drawn.at("T_R")));
    }
    wrong.series.push_back(std::move(errors));
    times.series.push_back(std::move(render));
  }
  report.figure({"paper_" + name, {wrong, times}}, title + ": wrong pixels and times");
}

}  // namespace

void write_paper(const json& section, Report& report) {
  report.heading("The paper's measurements");
  write_table(section.at("table"), report);
  write_dependences(section, report);
  if (section.contains("growth")) write_growth_of_models(section.at("growth"), report);
  if (section.contains("threshold")) {
    write_sweep(section.at("threshold"), "threshold_px", "threshold in pixels", "threshold",
                "Figure 3, K = 2", report);
  }
  if (section.contains("leaf_primitives")) {
    write_sweep(section.at("leaf_primitives"), "leaf_primitives", "K, primitives in a leaf at most",
                "leaf_primitives", "Without a threshold", report);
  }
}

}  // namespace report
