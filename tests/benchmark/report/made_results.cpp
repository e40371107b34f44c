#include "made_results.hpp"

#include <utility>

namespace made {

using nlohmann::json;

json times(double median) {
  return {{"median", median},
          {"least", 0.9 * median},
          {"quartiles", {0.95 * median, 1.1 * median}},
          {"count", 5}};
}

namespace {

json machine() {
  return {{"processor", "Abacus"},
          {"cores", 2},
          {"instruction_set", "AVX2"},
          {"memory_bytes", 8e9},
          {"system", "Debian"},
          {"compiler", "GCC 12"},
          {"commit", "0123456789"},
          {"date", "2026-01-02T03:04Z"},
          {"versions", {{"scadray", "0.1.0"}, {"POV-Ray", "3.7"}}}};
}

json whole_row(const char* design, const char* family, int primitives, double ms) {
  json stages;
  for (const char* stage : {"read", "parse", "import", "prepare", "render", "encode", "total"}) {
    stages[stage] = times(ms / 10);
  }
  return {{"design", design},         {"family", family},     {"primitives", primitives},
          {"file_bytes", 1'000'000},  {"wall_ms", times(ms)}, {"cpu_ms", times(1.5 * ms)},
          {"peak_bytes", 20'000'000}, {"stages_ms", stages}};
}

}  // namespace

json whole() {
  json fast = whole_row("cs100", "cs", 101, 8), slow = whole_row("cs1000", "cs", 1'001, 16);
  json large = whole_row("cs10000", "cs", 10'001, 32);
  fast["bar_ms"] = 10;
  slow["bar_ms"] = 15;
  large["bar_ms"] = 40;
  large["bar_bytes"] = 1e7;
  return {{"width_px", 640},
          {"height_px", 480},
          {"start_ms", times(1)},
          {"designs", {fast, slow, large}},
          {"growth",
           {{{"family", "cs"},
             {"from", 1'001},
             {"to", 10'001},
             {"exponent", 0.301},
             {"linear_log_exponent", 1.125}}}},
          {"left_out", {"cs1000000: no memory\nand more words"}}};
}

json results_of(json sections) {
  return {{"format", 1}, {"machine", machine()}, {"sections", std::move(sections)}};
}

}  // namespace made
