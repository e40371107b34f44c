#include <algorithm>

#include "report.hpp"
#include "text.hpp"

namespace report {
namespace {

using nlohmann::json;

constexpr const char* kPrecisions[] = {"double", "float"};

const char* title_of(const std::string& precision) {
  return precision == "double" ? "CPU, double" : "OpenGL, float";
}

double wrong_share(const json& row, const char* precision, double pixels) {
  return row.at(precision).at("wrong").get<double>() / pixels;
}

Panel wrong_panel(const json& curve, double pixels) {
  // No wrong pixel is drawn a decade below one.
  Panel panel{capitalised(curve.at("title")) + ": wrong pixels",
              {curve.at("parameter")},
              {"share of the picture"},
              {}};
  constexpr double kNone = 1e-5;
  panel.y.zero_at = kNone;
  panel.y.up_to = 1;
  for (const char* precision : kPrecisions) {
    Series series{title_of(precision), {}};
    for (const json& row : curve.at("rows")) {
      if (!row.contains(precision)) continue;
      series.points.push_back(point(row.at("value"), wrong_share(row, precision, pixels)));
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

Panel error_panel(const json& curve) {
  Panel panel{"Error of position", {curve.at("parameter")}, {"share of the model's size"}, {}};
  panel.y.zero_at = 1e-20;
  for (const char* precision : kPrecisions) {
    for (const auto& [key, name] :
         {std::pair{"median_error", "median"}, std::pair{"worst_error", "worst"}}) {
      Series series{std::string(title_of(precision)) + ", " + name, {}};
      for (const json& row : curve.at("rows")) {
        if (!row.contains(precision) || row.at(precision).at(key).is_null()) continue;
        series.points.push_back(point(row.at("value"), row.at(precision).at(key)));
      }
      panel.series.push_back(std::move(series));
    }
    Series rounding{"what rounding does to a coordinate", {}, Series::Style::kGuide};
    for (const json& row : curve.at("rows")) {
      if (!row.contains(precision)) continue;
      rounding.points.push_back(point(row.at("value"), row.at(precision).at("rounding")));
    }
    panel.series.push_back(std::move(rounding));
  }
  return panel;
}

struct Sum {
  double hits = 0, wrong = 0, undecided = 0, worst = 0;
};

Sum sum_of(const json& curve, const char* precision) {
  Sum sum;
  for (const json& row : curve.at("rows")) {
    if (!row.contains(precision)) continue;
    const json& errors = row.at(precision);
    sum.hits += row.at("hits").get<double>();
    sum.wrong += errors.at("wrong").get<double>();
    sum.undecided += errors.at("undecided").get<double>();
    if (!errors.at("worst_error").is_null()) {
      sum.worst = std::max(sum.worst, errors.at("worst_error").get<double>());
    }
  }
  return sum;
}

}  // namespace

void write_stability(const json& section, Report& report) {
  const json& curves = section.at("curves");
  if (curves.empty()) return;
  const double pixels =
      section.at("width_px").get<double>() * section.at("height_px").get<double>();
  report.heading("Numerical stability");
  std::string gl =
      section.contains("gl_renderer")
          ? " and by OpenGL in float (" + section.at("gl_renderer").get<std::string>() + ")"
          : "";
  report.text(
      "Scenes that become harder are drawn by the CPU in double" + gl +
      " and compared with rays in exact arithmetic, " + number(section.at("width_px")) + "×" +
      number(section.at("height_px")) +
      " pixels each. A pixel is wrong if it shows a hit for a miss, another primitive, or a "
      "place more than " +
      number(section.at("tolerances").at("double").at("position")) +
      " of the model's size away (in float " +
      number(section.at("tolerances").at("float").at("position")) +
      "). It is undecided, and not counted as wrong, if an exact ray 1e-12 of the size beside "
      "it sees something else.");
  Table table({"scene", "over", "precision", "hits", "wrong", "undecided", "worst position"});
  for (const json& curve : curves) {
    for (const char* precision : kPrecisions) {
      const Sum sum = sum_of(curve, precision);
      if (sum.hits == 0) continue;
      table.add({curve.at("title"), curve.at("parameter"), precision, whole_number(sum.hits),
                 whole_number(sum.wrong), whole_number(sum.undecided), number(sum.worst)});
    }
  }
  report.table(table);
  for (const json& curve : curves) {
    report.figure({"stability_" + curve.at("name").get<std::string>(),
                   {wrong_panel(curve, pixels), error_panel(curve)}},
                  "Errors of " + curve.at("title").get<std::string>() + " over the " +
                      curve.at("parameter").get<std::string>());
  }
}

}  // namespace report
