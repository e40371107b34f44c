#include <algorithm>
#include <cmath>
#include <map>

#include "report.hpp"
#include "text.hpp"

namespace report {
namespace {

using nlohmann::json;

/// The errors that the plots show, in a panel each.
struct Measure {
  const char* key;
  const char* title;
  const char* unit;
};
constexpr Measure kPlotted[] = {{"wrong", "wrong pixels", "share of the picture"},
                                {"depth_mean", "mean error of depth", "share of the model's size"}};

bool has_error(const json& point, const char* measure) {
  return point.at("error").contains(measure) && !point.at("error").at(measure).is_null();
}

/// Errors of pixels are counts, but as shares they do not depend on the picture's size.
double unit_of(const Measure& measure, double pixels) {
  return std::string(measure.key) == "wrong" ? pixels : 1;
}

/// Returns where errors of 0 are drawn: half a decade or more below the least error.
double place_of_zero(const json& scenes, const Measure& measure, double pixels) {
  double least = INFINITY;
  for (const json& scene : scenes) {
    for (const json& point : scene.at("points")) {
      if (!has_error(point, measure.key)) continue;
      const double error = point.at("error").at(measure.key).get<double>();
      if (error > 0) least = std::min(least, error / unit_of(measure, pixels));
    }
  }
  if (std::isinf(least)) return 1e-6;
  return std::pow(10.0, std::floor(std::log10(least / 3)));
}

Panel panel_of(const json& scene, const Measure& measure, double pixels, double zero_at) {
  Panel panel{design_title(scene.at("design")) + ": " + measure.title,
              {"time from file to picture, in ms"},
              {measure.unit},
              {}};
  panel.y.zero_at = zero_at;
  for (const json& point : scene.at("points")) {
    if (!has_error(point, measure.key)) continue;
    const std::string name = point.at("series");
    auto series = std::find_if(panel.series.begin(), panel.series.end(),
                               [&](const Series& one) { return one.name == name; });
    if (series == panel.series.end()) {
      series = panel.series.insert(panel.series.end(), Series{name, {}});
    }
    const double error = point.at("error").at(measure.key);
    series->points.push_back(
        report::point(median(point.at("time_ms")), error / unit_of(measure, pixels)));
  }
  return panel;
}

/// Writes a count or a share, or a dash if it is unknown.
std::string error_cell(const json& point, const char* measure) {
  return has_error(point, measure) ? number(point.at("error").at(measure)) : "–";
}

/// The design whose plot README.md shows, too.
constexpr char kSummaryDesign[] = "cs1000";

std::string name_of_figure(const std::string& design) { return "error_" + design; }

std::string alternative_of(const std::string& title) {
  return title + ": error over the time from file to picture";
}

void write_scene(const json& scene, double pixels, const std::vector<double>& zeros,
                 Report& report) {
  const std::string title = design_title(scene.at("design"));
  report.markdown += "\n### " + title + "\n";
  Figure figure{name_of_figure(scene.at("design")), {}};
  for (size_t i = 0; i < std::size(kPlotted); ++i) {
    figure.panels.push_back(panel_of(scene, kPlotted[i], pixels, zeros[i]));
  }
  report.figure(std::move(figure), alternative_of(title));
  Table table({"program", "setting", "ms", "wrong pixels", "silhouette", "worst depth",
               "mean depth", "wrong colours"});
  for (const json& point : scene.at("points")) {
    table.add({point.at("series"), point.at("setting"), with_spread(point.at("time_ms")),
               error_cell(point, "wrong"), error_cell(point, "silhouette"),
               error_cell(point, "depth_worst"), error_cell(point, "depth_mean"),
               error_cell(point, "colour_wrong")});
  }
  report.folded(title + ", all figures", table);
}

std::string with_setting(const std::string& program, const std::string& setting) {
  return setting.empty() ? program : program + ", " + setting;
}

/// Writes for each peer the level at which scadray leads by least.
void write_levels(const json& scenes, Report& report) {
  struct Least {
    const json* level;
    std::string design;
    size_t count;
  };
  std::map<std::string, Least> least;
  for (const json& scene : scenes) {
    for (const json& level : scene.at("levels")) {
      const std::string peer = level.at("series");
      const auto [entry, is_new] = least.try_emplace(peer, Least{&level, scene.at("design"), 0});
      ++entry->second.count;
      if (level.at("ratio") < entry->second.level->at("ratio")) {
        entry->second.level = &level;
        entry->second.design = scene.at("design");
      }
    }
  }
  if (least.empty()) return;
  report.text(
      "Each error that a peer reaches, against scadray's quickest picture with at most that "
      "error: where scadray is least ahead of each peer.");
  Table table({"peer", "errors reached", "scene", "setting", "measure", "its error", "its ms",
               "scadray", "its error", "its ms", "times as fast"});
  for (const auto& [peer, one] : least) {
    const json& level = *one.level;
    table.add({peer, whole_number(double(one.count)), design_title(one.design), level.at("setting"),
               level.at("measure"), number(level.at("error")), number(level.at("time_ms")),
               with_setting(level.at("scadray"), level.at("scadray_setting")),
               number(level.at("scadray_error")), number(level.at("scadray_ms")),
               number(level.at("ratio"))});
  }
  report.table(table);
}

}  // namespace

void write_error(const json& section, Report& report) {
  const json& scenes = section.at("scenes");
  if (scenes.empty()) return;
  const json& picture = section.at("picture");
  const double pixels = picture.at("pixels");
  report.heading("Time against error");
  report.text("From file to picture, whole processes, " + number(picture.at("width_px")) + "×" +
              number(picture.at("height_px")) +
              ", against the exact picture: scadray, and what else draws the same designs. To the "
              "left and further down is better; the lowest line is no error at all.");
  report.markdown += "\n";
  for (const auto& [key, sentence] : section.at("measures").items()) {
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', ' ');
    report.markdown += "- *" + name + "*: " + sentence.get<std::string>() + "\n";
  }
  Table ratios({"against", "scene", "its ms", "scadray's ms", "times as fast", "wanted"});
  for (const json& ratio : section.at("ratios")) {
    const bool is_met = ratio.at("ratio") >= ratio.at("at_least");
    ratios.add({ratio.at("what"), design_title(ratio.at("design")), number(ratio.at("time_ms")),
                number(ratio.at("scadray_ms")), number(ratio.at("ratio")),
                number(ratio.at("at_least")) + (is_met ? ": reached" : ": missed")});
  }
  report.table(ratios);
  write_levels(scenes, report);
  std::vector<double> zeros;
  for (const Measure& measure : kPlotted) zeros.push_back(place_of_zero(scenes, measure, pixels));
  for (const json& scene : scenes) write_scene(scene, pixels, zeros, report);
}

void write_error_summary(const json& section, const std::string& folder, std::string& summary) {
  Table ratios({"design", "against", "its ms", "scadray's ms", "times as fast"});
  for (const json& ratio : section.at("ratios")) {
    ratios.add({design_title(ratio.at("design")), ratio.at("what"), number(ratio.at("time_ms")),
                number(ratio.at("scadray_ms")), number(ratio.at("ratio"))});
  }
  if (!ratios.empty()) {
    const json& picture = section.at("picture");
    summary += paragraph("From file to picture at " + number(picture.at("width_px")) + "×" +
                         number(picture.at("height_px")) +
                         " pixels: medians of whole processes, but where the table says otherwise. "
                         "scadray draws on the CPU here.");
    summary += "\n" + ratios.markdown();
  }
  for (const json& scene : section.at("scenes")) {
    if (scene.at("design") != kSummaryDesign || scene.at("points").empty()) continue;
    summary += paragraph(
        "How far each program's picture is off, over the time that it takes: to the left and "
        "further "
        "down is better, and the lowest line is no error at all.");
    summary += "\n![" + alternative_of(design_title(kSummaryDesign)) + "](" + folder + "/" +
               name_of_figure(kSummaryDesign) + ".svg)\n";
  }
}

}  // namespace report
