#include <cstdio>

#include "measurement.hpp"

namespace bench {
namespace {

/// 1234567 → "1,234,567"
std::string grouped(uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
  return text;
}

/// Writes at least three digits.
std::string ms_text(double ms) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", ms < 1 ? 3 : ms < 10 ? 2 : ms < 100 ? 1 : 0, ms);
  return text;
}

constexpr const char* kRow = "    %-24s %10s %10s %10s %10s %7s\n";

std::string heading() {
  char text[128];
  std::snprintf(text, sizeof text, kRow, "", "median", "least", "lower", "upper", "runs");
  return "  milliseconds" + std::string(text).substr(14);
}

/// Returns the row of a time; nothing if it was not measured.
std::string row(const char* name, const Json& all, const char* key) {
  if (!all.contains(key)) return "";
  const Json& times = all[key];
  char text[160];
  std::snprintf(text, sizeof text, kRow, name, ms_text(times["median"]).c_str(),
                ms_text(times["least"]).c_str(), ms_text(times["quartiles"][0]).c_str(),
                ms_text(times["quartiles"][1]).c_str(), grouped(times["count"]).c_str());
  return text;
}

std::string table_of_frames(const Json& times) {
  std::string text = "  " + times["technique"].get<std::string>() + ", " +
                     times["renderer"].get<std::string>() + '\n';
  text += row("context's start", times, "context") + row("first frame", times, "first") +
          row("  of it subdividing", times, "first_subdivide") +
          row("  of it shaders", times, "first_shaders") + row("frame, steady", times, "steady");
  if (times["wrong_pixels"] > 0) {
    text += "    " + grouped(times["wrong_pixels"]) + " pixels show another face than the CPU's\n";
  }
  return text;
}

std::string table_of_rule(const Json& times) {
  const Json gl = times.value("gl", Json::object()), cpu = times.value("cpu", Json::object());
  const double threshold_px = times["threshold_px"];
  char name[128];
  std::snprintf(name, sizeof name, "cells below %g pixels dropped", threshold_px);
  std::string text = "  the paper's times, K = " + times["leaf_primitives"].dump() + ", " +
                     (threshold_px > 0 ? name : "no cell dropped") + ": " +
                     grouped(times["leaves"]) + " leaves";
  if (times["leaves_given_up"] > 0) {
    text += ", " + grouped(times["leaves_given_up"]) + " of them given up";
  }
  if (!gl.empty()) {
    text += ", " + grouped(gl["cells_drawn"]) + " cells in " + grouped(gl["draw_calls"]) +
            " draw calls";
  }
  const uint64_t wrong = (gl.empty() ? cpu : gl).value("wrong_pixels", uint64_t{0});
  if (wrong > 0) text += ", " + grouped(wrong) + " wrong pixels";
  return text + '\n' + row("S, subdivide", times, "S") + row("T_S, pass parameters", gl, "T_S") +
         row("T_R, traverse and render", gl, "T_R") + row("S_R, subdivide, render", gl, "S_R") +
         row("T_R by the CPU", cpu, "T_R");
}

}  // namespace

std::string table_of(const std::string& file, const Json& result) {
  std::string text = file + ": " + grouped(result["primitives"]) +
                     (result["primitives"] == 1 ? " primitive, " : " primitives, ") +
                     grouped(result["hits"]) + " of " + grouped(result["pixels"]) +
                     " pixels show it\n";
  if (result["frames"].empty() && result["rules"].empty() && result["wrong"].empty()) {
    return text + "  the design is empty: nothing to measure\n";
  }
  text += heading();
  for (const Json& times : result["frames"]) text += table_of_frames(times);
  for (const Json& times : result["rules"]) text += table_of_rule(times);
  for (const std::string reason : result["left_out"]) text += "  left out: " + reason + '\n';
  return text;
}

}  // namespace bench
