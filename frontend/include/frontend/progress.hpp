// A line on the terminal that shows the progress of long work.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace frontend {

/// Writes the line to stderr, once work has taken kSilence. Threads may share one object.
class ProgressLine {
 public:
  /// A disabled line never writes.
  explicit ProgressLine(bool enabled) : enabled_(enabled) {}
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `fraction` is in [0, 1]; below 0 it is unknown.
  void update(const char* stage, double fraction);
  /// Removes the line. To be called before anything else is written to stderr.
  void clear();

  static constexpr std::chrono::milliseconds kSilence{500};   // so that short runs show nothing
  static constexpr std::chrono::milliseconds kInterval{100};  // often enough for an eye

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_{};
  std::mutex mutex_;
};

}  // namespace frontend
