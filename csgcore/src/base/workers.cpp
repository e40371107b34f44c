#include "csgcore/workers.hpp"

#include <tbb/task_arena.h>

#include <system_error>
#include <thread>

namespace csgcore {

struct Workers::Started {
  tbb::task_arena arena;
  std::jthread thread;  // joined before the arena is destroyed
};

Workers::Workers() : started_(std::make_unique<Started>()) {
  try {
    started_->thread = std::jthread([&arena = started_->arena] { arena.enqueue([] {}); });
  } catch (const std::system_error&) {
    // No thread can be made. oneTBB will report that where it matters.
  }
}

Workers::~Workers() = default;

void Workers::run(const std::function<void()>& work) { started_->arena.execute(work); }

}  // namespace csgcore
