// The worker threads of everything in csgcore.
#pragma once

#include <functional>
#include <memory>

namespace csgcore {

/// Starts them beside what else has to be done first: the first parallel work of a program pays for
/// it otherwise, a millisecond, and up to 4 ms where another thread has to be made since the first
/// belong elsewhere (half of the pictures of CC1000: 9 ms instead of 5). Nothing but time depends
/// on it.
class Workers {
 public:
  Workers();
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Runs the work in the calling thread; what csgcore does in it, it does with these.
  void run(const std::function<void()>& work);

 private:
  struct Started;
  std::unique_ptr<Started> started_;
};

}  // namespace csgcore
