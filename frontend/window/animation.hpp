// The design's time, $t, which runs from 0 to 1 in steps, as OpenSCAD's "Animate" does.
#pragma once

#include <chrono>
#include <cstdint>

namespace window {

/// A frame is skipped rather than shown late.
class Animation {
 public:
  using Clock = std::chrono::steady_clock;

  static constexpr int kMostFrames_s = 60, kMostSteps = 9999;

  double time() const { return static_cast<double>(frame_) / steps_; }
  int frame() const { return frame_; }
  int steps() const { return steps_; }
  int frames_per_second() const { return frames_per_second_; }
  bool is_playing() const { return is_playing_; }

  void play(Clock::time_point now);
  void pause() { is_playing_ = false; }
  /// Pauses at the start.
  void stop();
  /// Sets the frame. While it plays, it goes on from there.
  void seek(int frame, Clock::time_point now);
  /// Set the number of frames, at which the time stays about the same, and their rate.
  void set_steps(int steps, Clock::time_point now);
  void set_frames_per_second(int frames, Clock::time_point now);

  /// Returns when the next frame is due, while it plays.
  Clock::time_point due() const;
  /// Goes to the frame that is due now. Returns whether that is another one.
  bool advance(Clock::time_point now);

 private:
  Clock::duration duration_of(int64_t frames) const;

  int frame_ = 0;
  int steps_ = 100;
  int frames_per_second_ = 25;
  bool is_playing_ = false;
  Clock::time_point start_{};  // when the first frame was shown
  int64_t shown_ = 0;          // frames since then, with those that were skipped
};

}  // namespace window
