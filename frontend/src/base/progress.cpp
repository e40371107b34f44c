#include "frontend/progress.hpp"

#include <algorithm>
#include <cstdio>

#include "frontend/terminal.hpp"

namespace frontend {

void ProgressLine::update(const char* stage, double fraction) {
  if (!enabled_) return;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (now - start_ < kSilence || now - last_ < kInterval) return;
  last_ = now;
  shown_ = true;
  const std::string shown = visible(stage);
  if (fraction < 0) {
    std::fprintf(stderr, "\r\033[K%s ...", shown.c_str());
  } else {
    std::fprintf(stderr, "\r\033[K%s %3.0f%%", shown.c_str(), 100 * std::min(fraction, 1.0));
  }
  std::fflush(stderr);
}

void ProgressLine::clear() {
  const std::lock_guard lock(mutex_);
  if (!shown_) return;
  shown_ = false;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
}

}  // namespace frontend
