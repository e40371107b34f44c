#include "times.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace timing {
namespace {

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace

void give_up(const std::string& what) {
  std::fprintf(stderr, "wrong answer: %s: no times\n", what.c_str());
  std::exit(1);
}

void Times::measure(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  wall_.push_back(time_ms(work));
  cpu_.push_back(1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
}

double Times::least() const { return *std::min_element(wall_.begin(), wall_.end()); }
double Times::median() const { return median_of(wall_); }
double Times::cpu() const { return median_of(cpu_); }

double time_ms(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  const auto end = std::chrono::steady_clock::now();
  return std::chrono::duration<double, std::milli>(end - start).count();
}

void report(const Times& times, benchmark::State& state) {
  state.counters["median_ms"] = times.median();
  state.counters["least_ms"] = times.least();
  state.counters["cpu_ms"] = times.cpu();
}

}  // namespace timing
