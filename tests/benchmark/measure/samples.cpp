#include "samples.hpp"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

namespace measure {
namespace {

/// Between neighbouring values where none stands at the place.
double quantile(std::span<const double> sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const size_t below = static_cast<size_t>(place);
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

Summary summarise(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.5), values.front(), quantile(values, 0.25), quantile(values, 0.75),
          values.size()};
}

void to_json(nlohmann::json& json, const Summary& summary) {
  json = {{"median", summary.median},
          {"least", summary.least},
          {"quartiles", {summary.lower_quartile, summary.upper_quartile}},
          {"count", summary.count}};
}

Timed timed(std::function<void()> work) {
  return [work = std::move(work)] {
    const auto start = std::chrono::steady_clock::now();
    work();
    const auto end = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(end - start).count();
  };
}

std::vector<Summary> measure_in_turn(std::span<const Timed> works, const Repetitions& repetitions) {
  for (const Timed& work : works) work();
  std::vector<std::vector<double>> times(works.size());
  double total_ms = 0;
  for (size_t round = 0; round < repetitions.most; ++round) {
    if (round >= repetitions.least && total_ms >= repetitions.long_enough_ms) break;
    for (size_t i = 0; i < works.size(); ++i) {
      times[i].push_back(works[i]());
      total_ms += times[i].back();
    }
  }
  std::vector<Summary> summaries;
  for (auto& values : times) summaries.push_back(summarise(std::move(values)));
  return summaries;
}

Summary measure(const Timed& work, const Repetitions& repetitions) {
  return measure_in_turn(std::span(&work, 1), repetitions).front();
}

}  // namespace measure
