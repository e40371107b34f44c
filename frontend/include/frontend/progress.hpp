// One line on a terminal that says what long work is at.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace frontend {

/// Writes to stderr, and only after kSilence of work. Threads may share it.
class ProgressLine {
 public:
  /// A disabled one never writes.
  explicit ProgressLine(bool enabled) : enabled_(enabled) {}
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// fraction in [0, 1]; below 0: not known.
  void update(const char* stage, double fraction);
  /// Removes the line, before anything else is written to stderr.
  void clear();

  static constexpr std::chrono::milliseconds kSilence{500};   // short runs show nothing
  static constexpr std::chrono::milliseconds kInterval{100};  // enough for an eye

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_{};
  std::mutex mutex_;
};

}  // namespace frontend
