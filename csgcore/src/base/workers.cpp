#include "csgcore/workers.hpp"

#include <tbb/task_arena.h>

#include <system_error>
#include <thread>

namespace csgcore {

struct Workers::Started {
  tbb::task_arena arena;
  std::jthread thread;  // joined before the arena goes
};

Workers::Workers() : started_(std::make_unique<Started>()) {
  try {
    started_->thread = std::jthread([&arena = started_->arena] { arena.enqueue([] {}); });
  } catch (const std::system_error&) {
    // No thread is to be had: oneTBB will say so where it matters.
  }
}

Workers::~Workers() = default;

void Workers::run(const std::function<void()>& work) { started_->arena.execute(work); }

}  // namespace csgcore
