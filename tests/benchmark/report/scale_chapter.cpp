#include <algorithm>
#include <cmath>

#include "report.hpp"
#include "text.hpp"

namespace report {
namespace {

using nlohmann::json;

struct Stage {
  const char* key;
  const char* title;
};
constexpr Stage kPrepare{"prepare_ms", "Preparing the tree for tracing"};
constexpr Stage kSubdivide{"subdivide_ms", "Subdividing"};
constexpr Stage kFirst{"first_ms", "A first picture, by tiles"};
constexpr Stage kSteady{"steady_ms", "A further picture, by cells"};

/// Plots one stage's times over a number of the rows, one series a scene.
Panel times_panel(const json& scenes, const char* name_key, const Stage& stage, const Axis& x,
                  double (*x_of)(const json& row)) {
  Panel panel{stage.title, x, {"time in ms"}, {}};
  for (const json& scene : scenes) {
    Series series{scene.at(name_key), {}};
    for (const json& row : scene.at("rows")) {
      series.points.push_back(summary_point(x_of(row), row.at(stage.key)));
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

double primitives_of(const json& row) { return row.at("primitives"); }
double threads_of(const json& row) { return row.at("threads"); }
double megapixels_of(const json& row) {
  return row.at("width_px").get<double>() * row.at("height_px").get<double>() / 1e6;
}

Panel sizes_panel(const json& families, const char* key, double unit, const char* title,
                  const char* axis) {
  Panel panel{title, {"primitives n"}, {axis}, {}};
  for (const json& family : families) {
    Series series{family.at("title"), {}};
    for (const json& row : family.at("rows")) {
      if (row.at(key).is_null()) continue;
      series.points.push_back(point(primitives_of(row), row.at(key).get<double>() / unit));
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

/// Returns the slope between the last two rows: 1 means growth proportional to n.
double last_exponent(const json& rows, const char* key) {
  const json &before = rows.at(rows.size() - 2), &last = rows.back();
  return std::log(median(last.at(key)) / median(before.at(key))) /
         std::log(primitives_of(last) / primitives_of(before));
}

void write_primitives(const json& section, Report& report) {
  const json& families = section.at("primitives");
  report.heading("How it grows with primitives");
  report.text(
      "Scenes are drawn from memory at " + number(section.at("width_px")) + "×" +
      number(section.at("height_px")) + " by " + number(section.at("threads")) +
      " threads of the CPU, in double. Preparing is done once for a file, subdividing only "
      "for pictures by cells. The table has the largest scene of each kind, with times in ms. "
      "Brackets say how the time grew from the size before, as an exponent of n (n log n has 1.06 "
      "to 1.2):");
  Table table({"scene", "primitives", "prepare", "subdivide", "first picture", "further picture",
               "leaf cells", "cells' memory", "peak memory"});
  for (const json& family : families) {
    const json& rows = family.at("rows");
    if (rows.empty()) continue;
    const json& last = rows.back();
    const auto cell = [&](const Stage& stage) {
      const std::string time = number(median(last.at(stage.key)));
      if (rows.size() < 2) return time;
      return time + " (" + number(last_exponent(rows, stage.key)) + ")";
    };
    table.add({family.at("title"), whole_number(primitives_of(last)), cell(kPrepare),
               cell(kSubdivide), cell(kFirst), cell(kSteady), whole_number(last.at("leaves")),
               bytes(last.at("subdivision_bytes")),
               last.at("peak_bytes").is_null() ? "–" : bytes(last.at("peak_bytes"))});
  }
  report.table(table);
  const auto panel = [&](const Stage& stage) {
    return times_panel(families, "title", stage, {"primitives n"}, primitives_of);
  };
  report.figure({"scale_pictures", {panel(kFirst), panel(kSteady)}},
                "Time of a picture over the number of primitives");
  report.figure({"scale_stages", {panel(kPrepare), panel(kSubdivide)}},
                "Time of the stages before a picture over the number of primitives");
  report.figure(
      {"scale_memory",
       {sizes_panel(families, "peak_bytes", 1e6, "Peak memory, all together", "memory in MB"),
        sizes_panel(families, "leaves", 1, "Leaf cells", "leaf cells")}},
      "Memory and cells over the number of primitives");
}

void write_unseen(const json& rows, Report& report) {
  if (rows.empty()) return;
  report.heading("What cannot be seen");
  Table table({"what joins 1,000 primitives that are seen", "ms alone", "ms with it", "ratio"});
  double largest = 0, smallest = INFINITY;
  for (const json& row : rows) {
    std::string name = row.at("scene");
    std::replace(name.begin(), name.end(), '_', ' ');
    const double ratio = row.at("ratio");
    largest = std::max(largest, ratio);
    smallest = std::min(smallest, ratio);
    table.add(
        {name, with_spread(row.at("alone_ms")), with_spread(row.at("grown_ms")), number(ratio)});
  }
  report.text(
      "99,000 primitives that do not change the picture join a scene of 1,000: the picture by "
      "tiles "
      "takes " +
      number(smallest) + " to " + number(largest) + " times as long as that of the 1,000 alone.");
  report.table(table);
}

void write_pixels(const json& section, Report& report) {
  const json& scenes = section.at("pixels");
  if (scenes.empty()) return;
  report.heading("Pixels and threads");
  const auto panel = [&](const Stage& stage) {
    return times_panel(scenes, "scene", stage, {"megapixels"}, megapixels_of);
  };
  report.figure({"scale_pixels", {panel(kFirst), panel(kSteady)}},
                "Time of a picture over its pixels");
  Table table(
      {"scene", "picture", "first picture, ms", "further picture, ms", "first, million pixels/s"});
  for (const json& scene : scenes) {
    const json& rows = scene.at("rows");
    for (const json* row : {&rows.front(), &rows.back()}) {
      table.add({design_title(scene.at("scene")),
                 whole_number(row->at("width_px")) + "×" + whole_number(row->at("height_px")),
                 number(median(row->at("first_ms"))), number(median(row->at("steady_ms"))),
                 number(megapixels_of(*row) / median(row->at("first_ms")) * 1'000)});
      if (rows.size() == 1) break;
    }
  }
  report.table(table);
}

void write_threads(const json& scenes, Report& report) {
  Table table({"scene", "picture", "threads", "subdivide, ms", "first picture, ms",
               "further picture, ms", "first picture, times as fast as by one"});
  size_t most_rows = 0;
  for (const json& scene : scenes) {
    const json& rows = scene.at("rows");
    most_rows = std::max(most_rows, rows.size());
    for (const json& row : rows) {
      table.add({design_title(scene.at("scene")),
                 whole_number(scene.at("width_px")) + "×" + whole_number(scene.at("height_px")),
                 number(threads_of(row)), number(median(row.at("subdivide_ms"))),
                 number(median(row.at("first_ms"))), number(median(row.at("steady_ms"))),
                 number(median(rows.front().at("first_ms")) / median(row.at("first_ms")))});
    }
  }
  report.table(table);
  // For two points a table suffices.
  if (most_rows < 3) return;
  Axis threads{"threads", false};
  report.figure({"scale_threads",
                 {times_panel(scenes, "scene", kFirst, threads, threads_of),
                  times_panel(scenes, "scene", kSteady, threads, threads_of)}},
                "Time of a picture over the number of threads");
}

}  // namespace

void write_scale(const json& section, Report& report) {
  write_primitives(section, report);
  write_unseen(section.at("unseen"), report);
  write_pixels(section, report);
  write_threads(section.at("threads_rows"), report);
}

}  // namespace report
