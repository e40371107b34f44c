#include "values/small_blocks.hpp"

#include <cstdlib>
#include <mutex>
#include <utility>

namespace language {

constinit thread_local SmallBlocks small_blocks;

// What no thread keeps: lists of each size, and memory that has not been used yet.
struct SmallBlocks::Depot {
  std::mutex mutex;
  std::array<Block*, kMostBytes / kStep> lists{};
  char *fresh = nullptr, *end = nullptr;
};

// Is not destroyed: values may be freed while the program ends.
SmallBlocks::Depot& SmallBlocks::depot() {
  static auto* const depot = new Depot;
  return *depot;
}

// Has this thread's lists handed over when it ends.
void SmallBlocks::clear_at_end() {
  thread_local struct Keeper {
    ~Keeper() { small_blocks.clear(); }
  } keeper;
  static_cast<void>(&keeper);
}

bool SmallBlocks::refill(List& list, size_t number) {
  constexpr size_t kChunkBytes = size_t{1} << 20, kBatchBytes = 4096;
  clear_at_end();
  Depot& all = depot();
  const std::lock_guard lock(all.mutex);
  list.room = kMostGiven;
  if (Block* const first = all.lists[number]) {
    all.lists[number] = first->next_list;
    list.first = first;
    return true;
  }
  if (static_cast<size_t>(all.end - all.fresh) < kBatchBytes) {
    auto* const chunk = static_cast<char*>(std::malloc(kChunkBytes));
    if (!chunk) return false;
    all.fresh = chunk;
    all.end = chunk + kChunkBytes;
  }
  const size_t size = (number + 1) * kStep;
  char* const batch = all.fresh;
  all.fresh += kBatchBytes;
  for (size_t offset = kBatchBytes / size * size; offset; offset -= size) {
    auto* const block = reinterpret_cast<Block*>(batch + offset - size);
    block->next = list.first;
    list.first = block;
  }
  return true;
}

void SmallBlocks::make_room(List& list, size_t number) noexcept {
  clear_at_end();  // of a thread that only gives, too
  hand_over(list, number);
  list.room = kMostGiven;
}

void SmallBlocks::hand_over(List& list, size_t number) noexcept {
  if (!list.first) return;
  Depot& all = depot();
  const std::lock_guard lock(all.mutex);
  list.first->next_list = std::exchange(all.lists[number], list.first);
  list = {};
}

void SmallBlocks::clear() noexcept {
  for (size_t number = 0; number < lists_.size(); ++number) hand_over(lists_[number], number);
}

}  // namespace language
