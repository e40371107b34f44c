#include <cmath>
#include <map>

#include "report.hpp"
#include "text.hpp"

namespace report {
namespace {

using nlohmann::json;

const std::map<std::string, std::string>& family_titles() {
  static const std::map<std::string, std::string> kTitles{{"cs", "CSn: a cylinder minus n spheres"},
                                                          {"cc", "CCn: a cylinder minus n cones"}};
  return kTitles;
}

/// Says what was asked for, and whether it is reached.
std::string bar_of(const json& row) {
  if (!row.contains("bar_ms")) return "";
  const double bar_ms = row.at("bar_ms");
  std::string bar = number(bar_ms) + " ms";
  bool is_met = median(row.at("wall_ms")) <= bar_ms;
  if (row.contains("bar_bytes")) {
    bar += ", " + bytes(row.at("bar_bytes"));
    is_met = is_met && row.at("peak_bytes") <= row.at("bar_bytes");
  }
  return bar + (is_met ? ": reached" : ": missed");
}

/// Returns a guide through the last of the points.
Series linear_log_guide(const std::vector<Point>& points) {
  Series guide{"n log n", {}, Series::Style::kGuide};
  if (points.size() < 2) return guide;
  const Point& last = points.back();
  for (const Point& at : points) {
    guide.points.push_back(
        point(at.x, last.y * at.x * std::log(at.x) / (last.x * std::log(last.x))));
  }
  return guide;
}

Panel growth_panel(const json& designs) {
  Panel panel{"From file to PNG, whole process", {"primitives n"}, {"time in ms"}, {}};
  std::vector<Point> longest;
  for (const auto& [family, title] : family_titles()) {
    Series series{title, {}};
    for (const json& row : designs) {
      if (row.at("family") != family) continue;
      series.points.push_back(summary_point(row.at("primitives"), row.at("wall_ms")));
    }
    if (series.points.size() > longest.size()) longest = series.points;
    panel.series.push_back(std::move(series));
  }
  panel.series.push_back(linear_log_guide(longest));
  return panel;
}

constexpr const char* kStages[] = {"read", "parse", "import", "prepare", "render", "encode"};

Panel stages_panel(const json& designs) {
  Panel panel{"CSn: what takes the time", {"primitives n"}, {"time in ms"}, {}};
  for (const char* stage : kStages) {
    Series series{stage, {}};
    for (const json& row : designs) {
      if (row.at("family") != "cs") continue;
      series.points.push_back(summary_point(row.at("primitives"), row.at("stages_ms").at(stage)));
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

std::string exponent(const json& step, const char* key) {
  return "n^" + number(step.at(key).get<double>());
}

void write_growth(const json& growth, Report& report) {
  // The last step of each family, in which costs that do not depend on n matter least.
  std::map<std::string, json> last;
  for (const json& step : growth) last[step.at("family")] = step;
  std::vector<std::string> sentences;
  for (const auto& [family, step] : last) {
    std::string name = family;
    for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    sentences.push_back(name + " grows as " + exponent(step, "exponent") + " from " +
                        number(step.at("from")) + " to " + number(step.at("to")) +
                        " primitives (n log n there: " + exponent(step, "linear_log_exponent") +
                        ")");
  }
  if (!sentences.empty()) report.text(listed(sentences) + ".");
}

}  // namespace

void write_whole(const json& section, Report& report) {
  const json& designs = section.at("designs");
  report.heading("From file to PNG");
  report.text(
      "Times are those of the whole process `scadray -o x.png FILE.csg`, from start to exit, at " +
      number(section.at("width_px")) + "×" + number(section.at("height_px")) +
      " by the CPU. A process that draws nothing (`scadray --version`) takes " +
      with_spread(section.at("start_ms")) + " ms.");
  Table table({"design", "primitives", "file", "ms", "processor ms", "peak memory", "wanted"});
  Table stages({"design", "read", "parse", "import", "prepare", "render", "encode"});
  for (const json& row : designs) {
    const std::string name = design_title(row.at("design"));
    table.add({name, whole_number(row.at("primitives")), bytes(row.at("file_bytes")),
               with_spread(row.at("wall_ms")), number(median(row.at("cpu_ms"))),
               bytes(row.at("peak_bytes")), bar_of(row)});
    std::vector<std::string> cells{name};
    for (const char* stage : kStages) {
      cells.push_back(number(median(row.at("stages_ms").at(stage))));
    }
    stages.add(cells);
  }
  report.table(table);
  write_growth(section.at("growth"), report);
  report.figure({"whole", {growth_panel(designs), stages_panel(designs)}},
                "Time from file to PNG over the number of primitives");
  report.text("The stages of these processes, in ms (`--stats`):");
  report.table(stages);
}

}  // namespace report
