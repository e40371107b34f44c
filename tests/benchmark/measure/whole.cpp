// From a file to its PNG: whole processes `scadray -o x.png FILE.csg`, from start to exit.
//
// {"width_px", "height_px", "start_ms": a process that draws nothing,
//  "designs": [{"design", "family" ("cs", "cc" or ""), "primitives", "file_bytes", "wall_ms",
//    "cpu_ms", "peak_bytes": the largest of all runs, "stages_ms": {STAGE: …}, "bar_ms",
//    "bar_bytes": what issue 6 asks for, if it does}],
//  "growth": [{"family", "from", "to": primitives, "exponent": of the growth between the two,
//    "linear_log_exponent": that of n log n there}],
//  "left_out"}
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include "designs.hpp"
#include "png.hpp"
#include "process.hpp"
#include "section.hpp"

namespace measure {
namespace {

using nlohmann::json;

constexpr uint32_t kWidth_px = 640, kHeight_px = 480;

/// The limit for the drawing program, for one picture: far beyond any.
constexpr double kLimit_s = 300;

struct Design {
  const char* name;
  const char* family;
  uint32_t primitives;  // the number in their name
  std::optional<double> bar_ms{};
  std::optional<double> bar_bytes{};
};

std::vector<Design> designs_of(const Settings& settings) {
  static const Design kAll[] = {{"r9", "", 9, 10},
                                {"t1022", "", 1022},
                                {"cs100", "cs", 100},
                                {"cs1000", "cs", 1'000, 15},
                                {"cs10000", "cs", 10'000, 40},
                                {"cs100000", "cs", 100'000},
                                {"cs1000000", "cs", 1'000'000, 4'000, 1e9},
                                {"cc100", "cc", 100},
                                {"cc200", "cc", 200},
                                {"cc500", "cc", 500},
                                {"cc1000", "cc", 1'000},
                                {"cc10000", "cc", 10'000}};
  static const std::set<std::string> kQuick{"r9", "cs100"};
  std::vector<Design> designs;
  for (const Design& design : kAll) {
    const bool wanted = settings.quick ? kQuick.count(design.name) > 0
                                       : design.primitives <= settings.most_primitives;
    if (wanted) designs.push_back(design);
  }
  return designs;
}

/// One design's picture, by the program itself.
class MeasuredRun {
 public:
  MeasuredRun(const Settings& settings, const std::string& design)
      : settings_(settings),
        csg_(csg_of(design, settings)),
        picture_(settings.work_folder / (design + ".png")),
        stats_(settings.work_folder / (design + ".json")) {}

  const std::filesystem::path& csg() const { return csg_; }

  ProcessResult run(const std::vector<std::string>& options = {}) const {
    std::vector<std::string> command{
        settings_.scadray,
        "-q",
        "-o",
        picture_,
        "--imgsize=" + std::to_string(kWidth_px) + "," + std::to_string(kHeight_px),
        "--renderer=cpu",
        "--threads=" + std::to_string(settings_.threads)};
    command.insert(command.end(), options.begin(), options.end());
    command.push_back(csg_);
    ProcessResult result = run_process(command, {kLimit_s});
    if (!result.succeeded()) throw WrongAnswer(csg_.string() + ": " + result.output);
    return result;
  }

  Png picture(const std::vector<std::string>& options) const {
    run(options);
    return read_png(picture_);
  }

  json stats() const {
    run({"--stats=" + stats_.string()});
    std::ifstream stream(stats_);
    return json::parse(stream);
  }

 private:
  const Settings& settings_;
  std::filesystem::path csg_, picture_, stats_;
};

/// Compares two methods that share no more than a ray's evaluation, and checks that something is
/// seen.
void require_right(const MeasuredRun& drawing) {
  const std::string name = drawing.csg().stem();
  const Png by_default = drawing.picture({});
  if (by_default.width_px != kWidth_px || by_default.height_px != kHeight_px ||
      is_blank(by_default)) {
    throw WrongAnswer(name + ": an empty picture");
  }
  for (const char* technique : {"--technique=tiles", "--technique=cells"}) {
    if (drawing.picture({technique}) != by_default) {
      throw WrongAnswer(name + ": another picture with " + technique);
    }
  }
}

/// The times that the program reports of its own stages, over several runs.
class Stages {
 public:
  void add(const json& stats) {
    static constexpr std::array kStages{"read",   "parse",  "import", "prepare",
                                        "render", "encode", "total"};
    for (const char* stage : kStages) times_[stage].push_back(stats.at("times_ms").at(stage));
  }
  json summaries() const {
    json result = json::object();
    for (const auto& [stage, times] : times_) result[stage] = summarise(times);
    return result;
  }

 private:
  std::map<std::string, std::vector<double>> times_;
};

json measure_design(const Design& design, const Settings& settings) {
  say(design.name);
  const MeasuredRun drawing(settings, design.name);
  require_right(drawing);

  std::vector<double> cpu_ms;
  uint64_t peak_bytes = 0;
  Stages stages;
  json stats;
  const Timed works[] = {[&] {
                           const ProcessResult result = drawing.run();
                           cpu_ms.push_back(result.cpu_ms);
                           peak_bytes = std::max(peak_bytes, result.peak_bytes);
                           return result.wall_ms;
                         },
                         timed([&] { stages.add(stats = drawing.stats()); })};
  const Summary wall_ms = measure_in_turn(works, settings.repetitions).front();

  json row{{"design", design.name},
           {"family", design.family},
           {"primitives", stats.at("primitives")},
           {"file_bytes", std::filesystem::file_size(drawing.csg())},
           {"wall_ms", wall_ms},
           {"cpu_ms", summarise(std::vector(cpu_ms.begin() + 1, cpu_ms.end()))},
           {"peak_bytes", peak_bytes},
           {"stages_ms", stages.summaries()}};
  if (design.bar_ms) row["bar_ms"] = *design.bar_ms;
  if (design.bar_bytes) row["bar_bytes"] = *design.bar_bytes;
  return row;
}

/// Returns the growth from each design of a family to the next larger one.
json growth_of(const json& rows) {
  json growth = json::array();
  for (size_t i = 1; i < rows.size(); ++i) {
    const json &before = rows[i - 1], &row = rows[i];
    if (row["family"] != before["family"] || row["family"] == "") continue;
    const double n = before["primitives"], m = row["primitives"];
    const double t = before["wall_ms"]["median"], u = row["wall_ms"]["median"];
    growth.push_back(
        {{"family", row["family"]},
         {"from", before["primitives"]},
         {"to", row["primitives"]},
         {"exponent", std::log(u / t) / std::log(m / n)},
         {"linear_log_exponent", 1 + std::log(std::log(m) / std::log(n)) / std::log(m / n)}});
  }
  return growth;
}

}  // namespace

json measure_whole(const Settings& settings) {
  const Timed start = [&] {
    const ProcessResult result = run_process({settings.scadray, "--version"});
    if (!result.succeeded()) throw WrongAnswer("scadray --version: " + result.output);
    return result.wall_ms;
  };
  LeftOut left_out;
  json rows = json::array();
  json result{{"width_px", kWidth_px},
              {"height_px", kHeight_px},
              {"start_ms", measure(start, settings.repetitions)}};
  for (const Design& design : designs_of(settings)) {
    try {
      rows.push_back(measure_design(design, settings));
    } catch (const WrongAnswer&) {
      throw;
    } catch (const std::runtime_error& error) {
      left_out.add(design.name, error.what());
    }
  }
  result["growth"] = growth_of(rows);
  result["designs"] = std::move(rows);
  result["left_out"] = left_out.reasons;
  return result;
}

}  // namespace measure
