#include "samples.hpp"

#include <chrono>
#include <utility>

namespace measure {

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
  for (size_t round = 0; !repetitions.enough(round, total_ms); ++round) {
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
