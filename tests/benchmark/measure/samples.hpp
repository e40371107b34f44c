// Repeated measurements of the same work, and what they come to.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

namespace measure {

/// Of values of one unit, at least one: the median, the least, the quartiles.
struct Summary {
  double median = 0;
  double least = 0;
  double lower_quartile = 0;
  double upper_quartile = 0;
  size_t count = 0;
};
Summary summarise(std::vector<double> values);
/// {"median", "least", "quartiles": [lower, upper], "count"}; every time in the results is one.
void to_json(nlohmann::json& json, const Summary& summary);

/// How often work is repeated: `least` times, and on until it took `long_enough_ms` in all or was
/// done `most` times.
struct Repetitions {
  size_t least = 5;
  size_t most = 50;
  double long_enough_ms = 2'000;
};

/// Work that takes its own time: returns ms.
using Timed = std::function<double()>;
/// Any work, timed by the clock on the wall.
Timed timed(std::function<void()> work);

/// Measures all of them in turn, one of each a round, so that what else the machine does meets all
/// alike. The first round warms up and does not count.
std::vector<Summary> measure_in_turn(std::span<const Timed> works, const Repetitions& repetitions);
Summary measure(const Timed& work, const Repetitions& repetitions);

}  // namespace measure
