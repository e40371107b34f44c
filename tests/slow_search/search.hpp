// Searches for small designs that take long to draw.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "archive.hpp"

namespace slow_search {

struct Settings {
  std::filesystem::path program;  // scadray
  uint64_t seed = 1;
  double seconds = 60;                        // the design that has begun is finished
  uint64_t designs = 0;                       // the most that are timed; 0: any number
  double limit_s = 3;                         // for one picture; then the program is killed
  double threshold_ms = 200;                  // beyond what `cube(1);` takes
  std::vector<std::filesystem::path> starts;  // .csg files, besides the families
  /// Asked before every design; false ends the search with its results so far.
  std::function<bool()> goes_on = [] { return true; };
  std::function<void(const std::string&)> say = [](const std::string&) {};
};

struct Result {
  double base_ms = 0;  // of `cube(1);`
  uint64_t designs = 0, drawn = 0;
  std::vector<Found> found;  // see Archive::ranked
};

/// Times pictures of 640 × 480 by the CPU: whole processes, the median of three. Throws
/// std::runtime_error if `cube(1);` cannot be drawn, and std::system_error.
Result search(const Settings& settings);

/// Writes the designs, and a table of them, found.txt, into an existing folder.
void write(const Result& result, const Settings& settings, const std::filesystem::path& folder);

}  // namespace slow_search
