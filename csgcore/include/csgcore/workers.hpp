// The worker threads of everything in csgcore.
#pragma once

#include <thread>

namespace csgcore {

/// Starts them in a thread of its own, beside what else has to be done first: the first parallel
/// work of a program pays for it otherwise, a millisecond. Nothing depends on it. The destructor of
/// what is returned waits until it is done.
[[nodiscard]] std::jthread start_workers();

}  // namespace csgcore
