// Text for people that may show on a terminal, which what a design says must not steer; and the
// line that shows the progress of long work there.
#pragma once

#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>

namespace frontend {

/// Returns a text with what it must not do to a terminal spelled as in a string of a design:
/// control characters but line feeds and tabs, marks that turn the direction of writing, and bytes
/// that are no UTF-8. "\x1b[2J" is eight characters then.
std::string visible(std::string_view text);

/// Writes a text to a stream: as it is to a file or a pipe, visible() to a terminal.
void print_text(std::FILE* stream, std::string_view text);

/// Writes a line with the progress of work to stderr, once work has taken kSilence. Threads may
/// share one object.
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
