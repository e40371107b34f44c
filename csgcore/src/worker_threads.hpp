// How many threads work on one thing.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace csgcore {

/// Runs with as many threads as are wanted; 0: as many as there are.
template <typename Work>
void with_threads(unsigned threads, Work&& work) {
  if (threads == 0) {
    work();
    return;
  }
  // TBB warns on stderr where an arena asks for more threads than the process is allowed.
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena arena(static_cast<int>(threads));
  arena.execute(work);
}

}  // namespace csgcore
