// What a thread is busy with, for whoever waits for it.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace frontend {

struct Activity {
  std::string stage;     // "evaluating"
  double fraction = -1;  // of the stage that is done, in [0, 1]; negative: unknown
  std::chrono::steady_clock::time_point since;  // when the whole work began
};

/// Set by the thread that works, and read by others. All functions may be called at any time.
class ActivityMeter {
 public:
  /// Work begins, unless it has begun already.
  void begin(const std::string& stage) {
    const std::lock_guard lock(mutex_);
    if (!activity_) activity_ = Activity{stage, -1, std::chrono::steady_clock::now()};
  }
  /// Names the stage of the work; nothing happens between end() and begin().
  void update(const std::string& stage, double fraction = -1) {
    const std::lock_guard lock(mutex_);
    if (!activity_) return;
    activity_->stage = stage;
    activity_->fraction = fraction;
  }
  void end() {
    const std::lock_guard lock(mutex_);
    activity_.reset();
  }
  /// Returns nothing while there is no work.
  std::optional<Activity> current() const {
    const std::lock_guard lock(mutex_);
    return activity_;
  }

 private:
  mutable std::mutex mutex_;
  std::optional<Activity> activity_;
};

}  // namespace frontend
