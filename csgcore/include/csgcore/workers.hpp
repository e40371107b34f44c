// The worker threads of csgcore: started ahead, and how many they may be.
#pragma once

#include <tbb/global_control.h>

#include <functional>
#include <memory>
#include <optional>

namespace csgcore {

/// Starts the worker threads while the caller does other work. Otherwise the first parallel work of
/// a program waits for them: a millisecond, or up to 4 ms if another thread has to be made since
/// the first ones belong elsewhere (half of the pictures of CC1000 took 9 ms instead of 5). Only
/// times depend on this class.
class Workers {
 public:
  Workers();
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Runs the work in the calling thread, and with these workers where csgcore works in parallel.
  void run(const std::function<void()>& work);

 private:
  struct Started;
  std::unique_ptr<Started> started_;
};

/// As long as it lives, no more than the given number of threads work in this process; 0: as many
/// as there are.
class ThreadLimit {
 public:
  explicit ThreadLimit(unsigned threads) {
    if (threads > 0) limit_.emplace(tbb::global_control::max_allowed_parallelism, threads);
  }

 private:
  std::optional<tbb::global_control> limit_;
};

}  // namespace csgcore
