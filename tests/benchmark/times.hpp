// Times of a benchmark's repetitions, and its end where an answer is wrong.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

namespace timing {

/// Ends the program, so that nobody sees a time of a wrong answer.
[[noreturn]] void give_up(const std::string& what);

/// The times of repetitions of the same work, in ms.
class Times {
 public:
  void measure(const std::function<void()>& work);
  double last() const { return wall_.back(); }
  double least() const;
  double median() const;
  /// The median of the processor time of all threads. It includes neither the load by other
  /// programs nor how well the threads share the work.
  double cpu() const;

 private:
  std::vector<double> wall_, cpu_;
};

double time_ms(const std::function<void()>& work);

/// Reports the times as median_ms, least_ms and cpu_ms.
void report(const Times& times, benchmark::State& state);

}  // namespace timing
