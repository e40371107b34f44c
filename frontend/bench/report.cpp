#include "report.hpp"

#include <cstdio>

namespace bench {
namespace {

using Json = nlohmann::ordered_json;

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

std::string row(const char* name, const Summary& times) {
  char text[160];
  std::snprintf(text, sizeof text, kRow, name, ms_text(times.median).c_str(),
                ms_text(times.least).c_str(), ms_text(times.lower_quartile).c_str(),
                ms_text(times.upper_quartile).c_str(), grouped(times.count).c_str());
  return text;
}

std::string row(const char* name, const std::optional<Summary>& times) {
  return times ? row(name, *times) : "";
}

std::string table_of(const FrameTimes& times) {
  std::string text = "  " + times.technique + ", " + times.renderer + '\n';
  text += row("context's start", times.context) + row("first frame", times.first) +
          row("  of it subdividing", times.subdivide) + row("  of it shaders", times.shaders) +
          row("frame, steady", times.steady);
  if (times.wrong_pixels > 0) {
    text += "    " + grouped(times.wrong_pixels) + " pixels show another face than the CPU's\n";
  }
  return text;
}

std::string table_of(const RuleTimes& times) {
  char name[128];
  std::snprintf(name, sizeof name, "  the paper's times, K = %u, ", times.rule.leaf_primitives);
  std::string text = name;
  std::snprintf(name, sizeof name, "cells below %g pixels dropped", times.rule.threshold_px);
  text += times.rule.threshold_px > 0 ? name : "no cell dropped";
  text += ": " + grouped(times.cells.leaves) + " leaves";
  if (times.cells.leaves_given_up > 0) {
    text += ", " + grouped(times.cells.leaves_given_up) + " of them given up";
  }
  if (times.gl) {
    text += ", " + grouped(times.gl->cells_drawn) + " cells in " + grouped(times.gl->draw_calls) +
            " draw calls";
  }
  const uint64_t wrong = times.gl ? times.gl->wrong_pixels : times.cpu_wrong_pixels;
  if (wrong > 0) text += ", " + grouped(wrong) + " wrong pixels";
  text += '\n' + row("S, subdivide", times.subdivide);
  if (times.gl) {
    text += row("T_S, pass parameters", times.gl->pass) +
            row("T_R, traverse and render", times.gl->render) +
            row("S_R, subdivide, render", times.gl->render_while_subdividing);
  }
  return text + row("T_R by the CPU", times.cpu_render);
}

template <typename Value>
void put(Json& json, const char* key, const std::optional<Value>& value) {
  if (value) json[key] = *value;
}

Json json_of(const FrameTimes& times) {
  Json json = {{"renderer", times.renderer}, {"technique", times.technique}};
  put(json, "context", times.context);
  json["first"] = times.first;
  put(json, "first_subdivide", times.subdivide);
  put(json, "first_shaders", times.shaders);
  json["steady"] = times.steady;
  json["wrong_pixels"] = times.wrong_pixels;
  return json;
}

}  // namespace

Json json_of(const RuleTimes& times) {
  Json json = {{"leaf_primitives", times.rule.leaf_primitives},
               {"threshold_px", times.rule.threshold_px},
               {"leaves", times.cells.leaves},
               {"leaves_dropped", times.cells.leaves_dropped},
               {"leaves_given_up", times.cells.leaves_given_up},
               {"S", times.subdivide}};
  if (times.gl) {
    json["gl"] = {{"T_S", times.gl->pass},
                  {"T_R", times.gl->render},
                  {"S_R", times.gl->render_while_subdividing},
                  {"draw_calls", times.gl->draw_calls},
                  {"cells_drawn", times.gl->cells_drawn},
                  {"wrong_pixels", times.gl->wrong_pixels}};
  }
  if (times.cpu_render) {
    json["cpu"] = {{"T_R", *times.cpu_render}, {"wrong_pixels", times.cpu_wrong_pixels}};
  }
  return json;
}

std::string table_of(const std::string& file, const Result& result) {
  std::string text = file + ": " + grouped(result.primitives) +
                     (result.primitives == 1 ? " primitive, " : " primitives, ") +
                     grouped(result.hits) + " of " + grouped(result.pixels) + " pixels show it\n";
  if (result.frames.empty() && result.rules.empty() && result.wrong.empty()) {
    return text + "  the design is empty: nothing to measure\n";
  }
  text += heading();
  for (const FrameTimes& times : result.frames) text += table_of(times);
  for (const RuleTimes& times : result.rules) text += table_of(times);
  for (const std::string& reason : result.left_out) text += "  left out: " + reason + '\n';
  return text;
}

Json json_of(const std::string& file, const Result& result) {
  Json frames = Json::array(), rules = Json::array();
  for (const FrameTimes& times : result.frames) frames.push_back(json_of(times));
  for (const RuleTimes& times : result.rules) rules.push_back(json_of(times));
  return {{"file", file},
          {"primitives", result.primitives},
          {"pixels", result.pixels},
          {"hits", result.hits},
          {"frames", frames},
          {"rules", rules},
          {"left_out", result.left_out},
          {"wrong", result.wrong}};
}

}  // namespace bench
