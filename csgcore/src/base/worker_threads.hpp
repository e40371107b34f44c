// How many threads work on one thing.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace csgcore {

/// Runs with as many threads as are wanted; 0: as many as there are. Where the caller has so many
/// already, they are taken: others would have to be woken.
template <typename Work>
void with_threads(unsigned threads, Work&& work) {
  if (threads == 0 || static_cast<int>(threads) == tbb::this_task_arena::max_concurrency()) {
    work();
    return;
  }
  // TBB warns on stderr where an arena asks for more threads than the process is allowed.
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena arena(static_cast<int>(threads));
  arena.execute(work);
}

}  // namespace csgcore
