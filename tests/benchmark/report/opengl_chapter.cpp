#include <algorithm>

#include "report.hpp"
#include "text.hpp"

namespace report {
namespace {

using nlohmann::json;

/// Returns "K = 8, by cells", or the rule with its threshold.
std::string rule_of(const json& frame) {
  std::string rule = "K = " + number(frame.at("leaf_primitives"));
  const double threshold_px = frame.at("threshold_px");
  if (threshold_px > 0) rule += ", " + number(threshold_px) + " pixel";
  return rule + ", by " + frame.at("technique").get<std::string>();
}

double frame_megapixels(const json& frame) {
  return frame.at("width_px").get<double>() * frame.at("height_px").get<double>() / 1e6;
}

/// Returns one design's frames over the picture's size, one series a rule.
Panel panel_of(const json& frames, const std::string& design) {
  Panel panel{design_title(design), {"megapixels"}, {"time of a frame in ms"}, {}};
  for (const json& frame : frames) {
    if (frame.at("design") != design) continue;
    const std::string name = rule_of(frame);
    auto series = std::find_if(panel.series.begin(), panel.series.end(),
                               [&](const Series& one) { return one.name == name; });
    if (series == panel.series.end()) {
      series = panel.series.insert(panel.series.end(), Series{name, {}});
    }
    series->points.push_back(summary_point(frame_megapixels(frame), frame.at("frame")));
  }
  return panel;
}

/// Writes the bar of issue 6, compared with the quickest of the frames that it is about.
void write_bar(const json& frames, bool is_software, Report& report) {
  const char* const design = is_software ? "cs1000" : "cs10000";
  const uint32_t height_px = is_software ? 480 : 2160;
  const double bar_ms = is_software ? 25 : 2;
  const json* quickest = nullptr;
  for (const json& frame : frames) {
    const bool is_asked = frame.at("design") == design && frame.at("height_px") == height_px &&
                          frame.at("threshold_px") == 0;
    if (!is_asked) continue;
    if (!quickest || median(frame.at("frame")) < median(quickest->at("frame"))) quickest = &frame;
  }
  if (!quickest) return;
  const double ms = median(quickest->at("frame"));
  report.text(design_title(design) + " at " + whole_number(quickest->at("width_px")) + "×" +
              whole_number(height_px) + " takes " + number(ms) + " ms a frame with " +
              rule_of(*quickest) + " (wanted " + (is_software ? "in software" : "on a GPU") +
              ": at most " + number(bar_ms) + " ms, " + (ms <= bar_ms ? "reached" : "missed") +
              ").");
}

}  // namespace

void write_opengl(const json& section, Report& report) {
  const json& frames = section.at("frames");
  if (frames.empty()) return;
  report.heading("OpenGL");
  const bool is_software = section.at("software");
  report.text(
      "A scene that is loaded is drawn frame by frame, from the view to the picture in memory, "
      "by " +
      section.at("renderer").get<std::string>() +
      (is_software ? ", which runs on the processor." : ".") +
      " *Traverse* brings the cells in their order, or the tiles' lists, to OpenGL; *draw* lasts "
      "until OpenGL has finished; *read* brings the picture back into memory. Wrong pixels are "
      "those that differ from the CPU's, of the pixels that show the design at the smallest "
      "size.");
  Table table({"design", "picture", "rule", "ms a frame", "traverse", "draw", "read", "frames/s",
               "leaf cells", "drawn", "draw calls", "wrong pixels"});
  std::vector<std::string> designs;
  for (const json& frame : frames) {
    const std::string design = frame.at("design");
    if (std::find(designs.begin(), designs.end(), design) == designs.end()) {
      designs.push_back(design);
    }
    table.add({design_title(design),
               whole_number(frame.at("width_px")) + "×" + whole_number(frame.at("height_px")),
               rule_of(frame), with_spread(frame.at("frame")), number(median(frame.at("traverse"))),
               number(median(frame.at("draw"))), number(median(frame.at("read"))),
               number(1'000 / median(frame.at("frame"))), whole_number(frame.at("leaves")),
               whole_number(frame.at("cells_drawn")), whole_number(frame.at("draw_calls")),
               whole_number(frame.at("wrong_pixels")) + " of " + whole_number(frame.at("hits"))});
  }
  write_bar(frames, is_software, report);
  Figure figure{"opengl", {}};
  for (const std::string& design : {std::string("cs1000"), std::string("cs10000")}) {
    figure.panels.push_back(panel_of(frames, design));
  }
  report.figure(std::move(figure), "Time of a frame by OpenGL over its pixels");
  report.folded("Every design, size and rule", table);
}

}  // namespace report
