// Tells when the mouse has rested over the picture.
#pragma once

#include <chrono>
#include <optional>
#include <utility>

#include "projection.hpp"

namespace window {

/// The mouse rests once it has moved, and then not for kRest. Whatever else the user does ends it.
class HoverTimer {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kRest{300};

  void move(const PicturePoint& place, Clock::time_point now) { moved_ = Moved{place, now}; }
  void stop() { moved_.reset(); }

  /// Returns when the mouse will have rested; nothing if it has not moved.
  std::optional<Clock::time_point> due() const {
    return moved_ ? std::optional(moved_->at + kRest) : std::nullopt;
  }
  /// Returns the place where the mouse rests, once.
  std::optional<PicturePoint> take(Clock::time_point now) {
    if (!moved_ || now < moved_->at + kRest) return std::nullopt;
    return std::exchange(moved_, std::nullopt)->place;
  }

 private:
  struct Moved {
    PicturePoint place;
    Clock::time_point at;
  };
  std::optional<Moved> moved_;
};

}  // namespace window
