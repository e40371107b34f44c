// The number of threads that work on one task.
#pragma once

#include <tbb/task_arena.h>

#include "csgcore/workers.hpp"

namespace csgcore {

/// Runs `work` with the given number of threads; 0: as many as there are. If the caller's arena has
/// just that number, work runs there, since other threads would have to be woken first.
template <typename Work>
void with_threads(unsigned threads, Work&& work) {
  if (threads == 0 || static_cast<int>(threads) == tbb::this_task_arena::max_concurrency()) {
    work();
    return;
  }
  // TBB warns on stderr if an arena asks for more threads than the process is allowed.
  const ThreadLimit limit(threads);
  tbb::task_arena arena(static_cast<int>(threads));
  arena.execute(work);
}

}  // namespace csgcore
