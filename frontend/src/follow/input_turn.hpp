// Decides when a followed design is read with inputs that have changed.
#pragma once

#include <chrono>
#include <optional>

namespace frontend {

/// A reading that is under way is let end, so that something is shown however often the inputs
/// change, unless it has taken long: its version would come late. Each reading that is stopped for
/// that doubles the time that the next one gets, until one has ended.
class InputTurn {
 public:
  using Clock = std::chrono::steady_clock;

  /// What a reading gets at first.
  static constexpr std::chrono::milliseconds kPatience{500};

  /// Notes that the inputs have changed.
  void notice(Clock::time_point now) {
    if (!noticed_) noticed_ = now;
  }
  /// Returns when the first of the changes was noticed that no reading has seen.
  const std::optional<Clock::time_point>& noticed() const { return noticed_; }
  /// Returns when to read with the new inputs, if a reading has been under way since then, or none
  /// is. Nothing if they have not changed.
  std::optional<Clock::time_point> due(std::optional<Clock::time_point> reading_since) const {
    if (!noticed_) return std::nullopt;
    return reading_since ? *reading_since + patience_ : Clock::time_point::min();
  }

  /// To be called when a reading starts; `stops_one`: for new inputs, in place of another one.
  void start(bool stops_one) {
    noticed_.reset();
    if (stops_one) patience_ *= 2;
  }
  /// To be called when a reading has ended by itself.
  void finish() { patience_ = kPatience; }
  /// Forgets the changes.
  void give_up() { noticed_.reset(); }

 private:
  std::optional<Clock::time_point> noticed_;
  Clock::duration patience_ = kPatience;
};

}  // namespace frontend
