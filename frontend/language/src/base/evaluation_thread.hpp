// The thread of an evaluation: its deep stack, and how long work in it notices that it is to stop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stop_token>

namespace language {

/// The work that this thread's evaluation may still do before it looks whether it is to stop. A
/// unit takes some nanoseconds: an element of a vector, or 32 bytes of text.
struct WorkMeter {
  int64_t left = 0;
  const std::stop_token* stop = nullptr;  // null: nothing can stop it
};
extern constinit thread_local WorkMeter work_meter;

/// Throws Stopped (language/stopped.hpp) if the evaluation is to stop.
void look_whether_to_stop();

/// Counts work that has been done. Throws Stopped within some milliseconds of a request to stop.
inline void count_work(size_t units = 1) {
  work_meter.left -= static_cast<int64_t>(units);
  if (work_meter.left < 0) look_whether_to_stop();
}

/// As long as it lives, the work of this thread can be stopped.
class WorkWatch {
 public:
  explicit WorkWatch(const std::stop_token& stop) { work_meter = {0, &stop}; }
  ~WorkWatch() { work_meter = {}; }
  WorkWatch(const WorkWatch&) = delete;
  WorkWatch& operator=(const WorkWatch&) = delete;
};

/// Calls `work` on a stack that holds so many nested symbols of a design, whatever the stack of the
/// caller; within another such call on that call's. Returns when it has ended, and throws
/// what it throws.
void with_deep_stack(uint32_t symbols, const std::function<void()>& work);

}  // namespace language
