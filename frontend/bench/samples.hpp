// Repeated measurements of the same work, and their summary.
#pragma once

#include <cstddef>
#include <vector>

namespace bench {

/// The median, minimum and quartiles of one or more values of one unit.
struct Summary {
  double median = 0;
  double least = 0;
  double lower_quartile = 0;
  double upper_quartile = 0;
  size_t count = 0;
};
Summary summarise(std::vector<double> values);
/// Writes {"median", "least", "quartiles": [lower, upper], "count"}, for any of nlohmann's types.
template <typename Json>
void to_json(Json& json, const Summary& summary) {
  json = {{"median", summary.median},
          {"least", summary.least},
          {"quartiles", {summary.lower_quartile, summary.upper_quartile}},
          {"count", summary.count}};
}

/// How often work is repeated: at least `least` times, and then until it has taken `long_enough_ms`
/// in all or was done `most` times.
struct Repetitions {
  size_t least = 5;
  size_t most = 50;
  double long_enough_ms = 2'000;
  bool enough(size_t count, double total_ms) const {
    return count >= least && (count >= most || total_ms >= long_enough_ms);
  }
};

}  // namespace bench
