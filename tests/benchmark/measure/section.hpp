// The sections of the measurements. Each checks its answers before it takes a time.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "samples.hpp"

namespace measure {

struct Settings {
  /// The programs that are measured, of the same build as this program.
  std::filesystem::path scadray;
  std::filesystem::path examples;
  /// The folder for exported designs and pictures, which is kept from run to run.
  std::filesystem::path work_folder;
  /// If a peer takes longer for a picture, that picture and all harder ones are left out for it.
  double peer_limit_s = 60;
  /// The largest scene of the sections about size.
  uint32_t most_primitives = 1'000'000;
  /// Measure only a few of each kind, to see that everything works.
  bool quick = false;
  unsigned threads = 2;
  Repetitions repetitions{};
  /// A long section hands over its results so far, so that an early end loses only the rest.
  std::function<void(const nlohmann::json& so_far)> keep = [](const nlohmann::json&) {};
};

/// A picture is wrong: none of its times may be reported.
struct WrongAnswer : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Writes a line of progress to stderr.
void say(const std::string& line);

/// A list of strings "what: why", under "left_out" of a section: what the machine does not have, or
/// what took too long.
struct LeftOut {
  std::vector<std::string> reasons;
  void add(const std::string& what, const std::string& why);
};

struct Section {
  const char* name;
  const char* title;
  /// Measures the section. Throws WrongAnswer.
  nlohmann::json (*measure)(const Settings& settings);
};
std::span<const Section> sections();

nlohmann::json measure_paper(const Settings& settings);      // Table 1, figures 3 and 14, §4.1
nlohmann::json measure_error(const Settings& settings);      // time against error, with peers
nlohmann::json measure_frames(const Settings& settings);     // a moved camera, Embree beside it
nlohmann::json measure_whole(const Settings& settings);      // file to PNG, whole processes
nlohmann::json measure_scale(const Settings& settings);      // primitives, pixels, threads
nlohmann::json measure_stability(const Settings& settings);  // the stress suite's errors
nlohmann::json measure_opengl(const Settings& settings);     // frames, by which technique

}  // namespace measure
