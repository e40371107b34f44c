// Ends long work early: the work passes stop points, and its caller sets a token.
#pragma once

#include <stop_token>
#include <utility>

namespace csgcore {

/// Thrown by work that was asked to stop. It is not an error.
struct Stopped {};

/// The token of the work that this thread does; null: nothing stops it.
inline constinit thread_local const std::stop_token* stop_of_work = nullptr;

/// As long as it lives, the token stops the work of this thread. The threads that a part of the
/// work is given to need a scope of their own, with the stop_of_work of this one.
class StopScope {
 public:
  explicit StopScope(const std::stop_token* stop) : before_(std::exchange(stop_of_work, stop)) {}
  ~StopScope() { stop_of_work = before_; }
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  const std::stop_token* before_;
};

/// Throws Stopped if this thread's work is to stop. Takes a nanosecond: loops whose rounds take a
/// microsecond and more may call it in each.
inline void stop_point() {
  if (stop_of_work != nullptr && stop_of_work->stop_requested()) throw Stopped();
}

}  // namespace csgcore
