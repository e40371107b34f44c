#include "animation.hpp"

#include <algorithm>
#include <cmath>

namespace window {

void Animation::play(Clock::time_point now) {
  is_playing_ = true;
  start_ = now;
  shown_ = 0;
}

void Animation::stop() {
  pause();
  frame_ = 0;
}

void Animation::seek(int frame, Clock::time_point now) {
  frame_ = std::clamp(frame, 0, steps_ - 1);
  if (is_playing_) play(now);
}

void Animation::set_steps(int steps, Clock::time_point now) {
  const double time_before = time();
  steps_ = std::clamp(steps, 1, kMostSteps);
  seek(static_cast<int>(std::lround(time_before * steps_)), now);
}

void Animation::set_frames_per_second(int frames, Clock::time_point now) {
  frames_per_second_ = std::clamp(frames, 1, kMostFrames_s);
  if (is_playing_) play(now);
}

Animation::Clock::duration Animation::duration_of(int64_t frames) const {
  return std::chrono::nanoseconds(frames * std::nano::den / frames_per_second_);
}

Animation::Clock::time_point Animation::due() const { return start_ + duration_of(shown_ + 1); }

bool Animation::advance(Clock::time_point now) {
  if (!is_playing_ || now < due()) return false;
  const int64_t passed = (now - start_) / duration_of(1);
  frame_ = static_cast<int>((frame_ + std::max(passed - shown_, int64_t{1})) % steps_);
  shown_ = std::max(passed, shown_ + 1);
  return steps_ > 1;
}

}  // namespace window
