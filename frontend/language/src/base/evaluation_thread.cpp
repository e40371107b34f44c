#include "base/evaluation_thread.hpp"

#include <pthread.h>

#include <exception>

#include "language/stopped.hpp"

namespace language {

namespace {

thread_local bool has_deep_stack = false;

struct Job {
  const std::function<void()>& work;
  std::exception_ptr thrown;
};

void* run(void* argument) {
  auto& job = *static_cast<Job*>(argument);
  has_deep_stack = true;
  try {
    job.work();
  } catch (...) {
    job.thrown = std::current_exception();
  }
  has_deep_stack = false;
  return nullptr;
}

}  // namespace

constinit thread_local WorkMeter work_meter;

void look_whether_to_stop() {
  constexpr int64_t kUnitsBetweenLooks = int64_t{1} << 18;
  work_meter.left = kUnitsBetweenLooks;
  if (work_meter.stop && work_meter.stop->stop_requested()) throw Stopped();
}

void with_deep_stack(uint32_t symbols, const std::function<void()>& work) {
  if (has_deep_stack) return work();
  // A parenthesis takes four frames, which take up to 4 kB where sanitizers widen them. Only what
  // is touched costs memory.
  constexpr size_t kBytesOfSymbol = 6700;
  Job job{work, nullptr};
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, symbols * kBytesOfSymbol);
  pthread_t thread;
  const bool is_running = pthread_create(&thread, &attributes, run, &job) == 0;
  pthread_attr_destroy(&attributes);
  if (is_running) {
    pthread_join(thread, nullptr);
  } else {
    run(&job);  // without room for another stack, an ordinary design still fits this one
  }
  if (job.thrown) std::rethrow_exception(job.thrown);
}

}  // namespace language
