// Measures time against error: how long a user waits for a picture of a file, and how wrong it is,
// with scadray and with its peers.
//
// {"picture": {"width_px", "height_px", "pixels"},
//  "measures": {KEY: what it counts}: the keys of "error", and a sentence for each,
//  "scenes": [{"design", "primitives", "hits",
//    "check": {"judge", "pixels", "undecided", "position_worst"}: the exact picture is the judge's;
//      undecided: pixels at which no double can be held to it,
//    "points": [{"series", "setting": a series' points rise in quality,
//      "is_scadray", "time_ms": Summary, from the file to the picture, the whole process (CGAL Nef:
//        to the solid, without a picture), "trace_ms": Summary, only where the program says it,
//      "error_by": "pixels": its own; "facets": exact pixels of its facets (colours its own),
//      "error": {"wrong", "silhouette", "depth_worst", "depth_mean", "colour_wrong", "colour_rms"}:
//        each a number, or null where it cannot be had}],
//    "levels": [{"series", "setting", "measure", "error", "time_ms": what a peer reaches,
//      "scadray", "scadray_setting", "scadray_error", "scadray_ms": scadray's quickest point of at
//        most that error, "ratio"}]}],
//  "ratios": [{"what", "design", "time_ms", "scadray_ms", "ratio", "at_least"}],
//  "left_out": ["what: why"]}
#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include "peers/candidate.hpp"
#include "section.hpp"
#include "x_server.hpp"

namespace measure {
namespace {

using nlohmann::json;

/// Work that takes longer is run by itself, a few times; other work in turn.
constexpr double kSlow_ms = 1'000;
constexpr size_t kSlowRuns = 3;
/// Work that takes longer is run once, unless a bar asks for it.
constexpr double kVerySlow_ms = 6'000;
constexpr Repetitions kInTurn{5, 9, 500};
/// A pause before each run, so that what the run before it leaves to do does not count (an X server
/// starts over when OpenSCAD has gone, for some 50 ms).
constexpr std::chrono::milliseconds kPause{100};
/// With twice the fragments, an exact solid takes about this many times as long.
constexpr double kGrowth = 3.5;

/// A bar for scadray's whole process, which the report names.
struct Bar {
  const char *series, *setting, *design;
  bool by_trace;
  double at_least;
};
constexpr Bar kBars[] = {{"OpenSCAD preview", "$fn=48", "cs1000", false, 200},
                         {"OpenSCAD preview", "$fn=48", "cc1000", false, 50},
                         {"POV-Ray", "", "cs1000", true, 25}};

const json kMeasures = {
    {"wrong", "pixels whose centre shows another primitive than it ought to, or a hit for a miss"},
    {"silhouette", "pixels whose centre shows a hit for a miss, or a miss for a hit"},
    {"depth_worst",
     "furthest along the view axis, as a share of the model's diagonal, of the "
     "pixels that are hits in both pictures"},
    {"depth_mean", "the same, on the average"},
    {"colour_wrong", "pixels with a channel more than 24 of 255 from the exact picture's"},
    {"colour_rms",
     "root of the mean square of all channels, in levels of 255, against the exact "
     "picture antialiased by 64 rays a pixel"}};

bool is_of(const Bar& bar, const Candidate& candidate, const std::string& design) {
  return bar.series == candidate.series && bar.setting == candidate.setting && bar.design == design;
}

struct Point {
  Candidate candidate;
  PictureErrors errors;
  std::vector<double> first_ms;  // of slow work: all its runs, the first included
  Summary time, trace;
  std::shared_ptr<std::vector<double>> traces_ms = std::make_shared<std::vector<double>>();
};

/// Notes where a series has run out of time. Finer facets of the same design are harder; and if
/// even the coarsest solid took too long, so do all designs of as many primitives.
class Limits {
 public:
  struct Limit {
    std::string series, design;
    size_t primitives;
    uint32_t fragments;
    bool holds_for_larger;
    std::string why;
  };
  void add(const Candidate& candidate, const ExactDesign& subject, uint32_t fragments,
           bool holds_for_larger, const std::string& why) {
    limits_.push_back({candidate.series, subject.design(), subject.scene().primitives.size(),
                       fragments, holds_for_larger,
                       subject.design() + ", " + candidate.setting + ": " + why});
  }
  const Limit* of(const Candidate& candidate, const ExactDesign& subject) const {
    for (const Limit& limit : limits_) {
      const bool is_harder =
          subject.design() == limit.design ||
          (limit.holds_for_larger && subject.scene().primitives.size() >= limit.primitives);
      if (limit.series == candidate.series && is_harder && candidate.fragments >= limit.fragments) {
        return &limit;
      }
    }
    return nullptr;
  }

 private:
  std::vector<Limit> limits_;
};

std::string seconds(double ms) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", ms / 1000);
  return text;
}

class SceneMeasurement {
 public:
  SceneMeasurement(const std::string& design, const Settings& settings, Limits& limits,
                   LeftOut& left_out)
      : subject_(design, settings), settings_(settings), limits_(limits), left_out_(left_out) {}

  void add(std::vector<Candidate> candidates) {
    for (Candidate& candidate : candidates) add(std::move(candidate));
  }
  ExactDesign& subject() { return subject_; }

  /// Computes the times.
  void finish() {
    std::vector<Timed> works;
    std::vector<Point*> quick;
    for (Point& point : points_) {
      if (!point.first_ms.empty()) {
        point.time = summarise(point.first_ms);
      } else {
        quick.push_back(&point);
        works.push_back([&point] { return run(point); });
      }
    }
    if (!works.empty()) {
      for (Point* point : quick) point->traces_ms->clear();
      const std::vector<Summary> times =
          measure_in_turn(works, settings_.quick ? settings_.repetitions : in_turn(works.size()));
      for (size_t i = 0; i < quick.size(); ++i) quick[i]->time = times[i];
    }
    for (Point& point : points_) {
      if (!point.traces_ms->empty()) point.trace = summarise(*point.traces_ms);
    }
  }

  json results() const;
  void add_ratios(json& ratios) const;

 private:
  /// The limit on the time applies to each work.
  static Repetitions in_turn(size_t works) {
    Repetitions repetitions = kInTurn;
    repetitions.long_enough_ms *= static_cast<double>(works);
    return repetitions;
  }

  static double run(Point& point) {
    std::this_thread::sleep_for(kPause);
    const Run result = point.candidate.run();
    if (!result.failure.empty()) {
      throw std::runtime_error(point.candidate.series + ": " + result.failure);
    }
    if (result.trace_ms) point.traces_ms->push_back(*result.trace_ms);
    return result.wall_ms;
  }

  std::string name_of(const Candidate& candidate) const {
    return candidate.series + (candidate.setting.empty() ? "" : ", " + candidate.setting) + ", " +
           subject_.design();
  }

  void add(Candidate candidate) {
    if (const Limits::Limit* limit = limits_.of(candidate, subject_)) {
      left_out_.add(name_of(candidate), limit->why);
      return;
    }
    const Run first = candidate.run();
    say(name_of(candidate) + ": " + (first.timed_out ? "too long" : seconds(first.wall_ms)));
    if (first.timed_out) {
      const std::string why = "more than " + seconds(1000 * settings_.peer_limit_s);
      left_out_.add(name_of(candidate), why);
      const bool is_coarsest = candidate.fragments == kCoarsest;
      limits_.add(candidate, subject_, candidate.fragments, candidate.makes_solid && is_coarsest,
                  why);
      return;
    }
    if (!first.failure.empty()) {
      left_out_.add(name_of(candidate), first.failure);
      return;
    }
    if (kGrowth * first.wall_ms > 1000 * settings_.peer_limit_s && candidate.makes_solid) {
      limits_.add(candidate, subject_, candidate.fragments + 1, false, seconds(first.wall_ms));
    }
    Point point;
    point.errors = candidate.judge();
    point.candidate = std::move(candidate);
    if (first.wall_ms > kSlow_ms) measure_slow(point, first);
    points_.push_back(std::move(point));
  }

  /// Measures a slow point, unless only its first run was slow, by compiling a shader, for example.
  void measure_slow(Point& point, const Run& first) {
    point.first_ms.push_back(first.wall_ms);
    if (first.trace_ms) point.traces_ms->push_back(*first.trace_ms);
    const bool is_repeated = point.candidate.is_scadray || first.wall_ms <= kVerySlow_ms ||
                             std::any_of(std::begin(kBars), std::end(kBars), [&](const Bar& bar) {
                               return is_of(bar, point.candidate, subject_.design());
                             });
    while (is_repeated && point.first_ms.size() < kSlowRuns) {
      point.first_ms.push_back(run(point));
      if (point.first_ms.back() <= kSlow_ms) point.first_ms.clear();
      if (point.first_ms.empty()) return;
    }
  }

  ExactDesign subject_;
  const Settings& settings_;
  Limits& limits_;
  LeftOut& left_out_;
  std::vector<Point> points_;
};

json json_of(const Point& point) {
  json result = {{"series", point.candidate.series},         {"setting", point.candidate.setting},
                 {"is_scadray", point.candidate.is_scadray}, {"time_ms", point.time},
                 {"error_by", point.candidate.error_by},     {"error", point.errors}};
  if (point.trace.count > 0) result["trace_ms"] = point.trace;
  return result;
}

/// Returns for each error that a peer reaches scadray's quickest point with at most that error.
json levels_of(const std::vector<Point>& points) {
  json levels = json::array();
  for (const Point& peer : points) {
    if (peer.candidate.is_scadray) continue;
    const json reached = peer.errors;
    for (const auto& [measure, error] : reached.items()) {
      if (error.is_null()) continue;
      const Point* best = nullptr;
      for (const Point& ours : points) {
        const json value = json(ours.errors).at(measure);
        if (!ours.candidate.is_answer || value.is_null() || value > error) continue;
        if (!best || ours.time.median < best->time.median) best = &ours;
      }
      json level = {{"series", peer.candidate.series},
                    {"setting", peer.candidate.setting},
                    {"measure", measure},
                    {"error", error},
                    {"time_ms", peer.time.median}};
      if (best) {
        level.update({{"scadray", best->candidate.series},
                      {"scadray_setting", best->candidate.setting},
                      {"scadray_error", json(best->errors).at(measure)},
                      {"scadray_ms", best->time.median},
                      {"ratio", peer.time.median / best->time.median}});
      }
      levels.push_back(std::move(level));
    }
  }
  return levels;
}

json SceneMeasurement::results() const {
  json points = json::array();
  for (const Point& point : points_) points.push_back(json_of(point));
  const auto& primitives = subject_.exact().primitive;
  const auto misses = std::count(primitives.begin(), primitives.end(), csgcore::Hits::kMiss);
  return {{"design", subject_.design()},
          {"primitives", subject_.scene().primitives.size()},
          {"hits", static_cast<int64_t>(primitives.size()) - misses},
          {"check", subject_.check()},
          {"points", points},
          {"levels", levels_of(points_)}};
}

void SceneMeasurement::add_ratios(json& ratios) const {
  const double scadray_ms = points_.front().time.median;
  for (const Bar& bar : kBars) {
    for (const Point& point : points_) {
      if (!is_of(bar, point.candidate, subject_.design())) continue;
      const double time_ms = bar.by_trace ? point.trace.median : point.time.median;
      const std::string what = bar.series + (*bar.setting ? std::string(", ") + bar.setting : "") +
                               (bar.by_trace ? ", the trace alone" : "");
      ratios.push_back({{"what", what},
                        {"design", bar.design},
                        {"time_ms", time_ms},
                        {"scadray_ms", scadray_ms},
                        {"ratio", time_ms / scadray_ms},
                        {"at_least", bar.at_least}});
    }
  }
}

/// Returns the designs from the easy to the hard.
std::vector<std::string> designs(const Settings& settings) {
  if (settings.quick) return {"r9", "cs100"};
  // Designs that bars ask for come first.
  return {"r9", "cs1000", "cc1000", "cs100", "t1022", "flange", "knob", "bracket"};
}

}  // namespace

json measure_error(const Settings& settings) {
  LeftOut left_out;
  const XServer display;
  const bool has_openscad = display.running() && !find_program("openscad").empty();
  if (!has_openscad) left_out.add("OpenSCAD", "openscad and Xvfb are not both there");
  const bool has_povray = !find_program("povray").empty();
  if (!has_povray) left_out.add("POV-Ray", "there is no povray");
  for (const char* peer : {"Manifold", "libfive", "BRL-CAD"}) {
    left_out.add(peer, "Debian 12 has no package of it");
  }
  Limits limits;
  json result{{"picture", {{"width_px", 640}, {"height_px", 480}, {"pixels", 640 * 480}}},
              {"measures", kMeasures},
              {"scenes", json::array()},
              {"ratios", json::array()}};
  for (const std::string& design : designs(settings)) {
    say(design);
    SceneMeasurement scene(design, settings, limits, left_out);
    scene.add(scadray_candidates(scene.subject()));
    if (has_povray) scene.add(povray_candidates(scene.subject()));
    if (has_openscad) scene.add(openscad_candidates(scene.subject(), display.display()));
    scene.add(nef_candidates(scene.subject()));
    scene.finish();
    result["scenes"].push_back(scene.results());
    scene.add_ratios(result["ratios"]);
    result["left_out"] = left_out.reasons;
    settings.keep(result);
  }
  return result;
}

}  // namespace measure
