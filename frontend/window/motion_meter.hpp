// Measures how many pictures a second are shown while something moves.
#pragma once

#include <chrono>
#include <cstdint>

namespace window {

class MotionMeter {
 public:
  using Clock = std::chrono::steady_clock;

  /// Counts a picture of a motion, which is on the screen.
  void count(Clock::time_point now) {
    // The time between two motions does not count.
    if (pictures_ == 0 || now - last_ > kLongestGap) {
      first_ = now;
      pictures_ = 0;
    }
    last_ = now;
    ++pictures_;
  }

  /// The rate of the last motion; 0 if too few of its pictures were seen.
  double frames_per_second() const {
    const double seconds = std::chrono::duration<double>(last_ - first_).count();
    return pictures_ >= kFewest && seconds > 0 ? (pictures_ - 1) / seconds : 0;
  }

 private:
  static constexpr std::chrono::milliseconds kLongestGap{250};
  static constexpr uint64_t kFewest = 5;

  Clock::time_point first_{}, last_{};
  uint64_t pictures_ = 0;
};

}  // namespace window
