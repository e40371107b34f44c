#include "values/object_memory.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

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

constinit thread_local ObjectMemory object_memory;

void* resize_object(void* block, size_t bytes, size_t new_bytes) {
  if (SmallBlocks::holds(bytes) || SmallBlocks::holds(new_bytes)) {
    void* const moved = allocate_object(new_bytes);
    std::memcpy(moved, block, std::min(bytes, new_bytes));
    free_object(block, bytes);
    return moved;
  }
  if (new_bytes > bytes) check_text_size(new_bytes - bytes);
  void* const moved = std::realloc(block, new_bytes);
  if (!moved) throw OutOfValueMemory();
  object_memory.used += static_cast<int64_t>(new_bytes) - static_cast<int64_t>(bytes);
  return moved;
}

void keep_freed_memory() {
#ifdef __GLIBC__
  // Larger blocks are mapped one by one, which realloc() moves without copying. glibc would raise
  // both thresholds itself, but only when a mapped block happens to be freed.
  constexpr int kMappedBytes = 1 << 20, kKeptBytes = 8 << 20;
  static const bool is_set =
      mallopt(M_MMAP_THRESHOLD, kMappedBytes) && mallopt(M_TRIM_THRESHOLD, kKeptBytes);
  static_cast<void>(is_set);
#endif
}

}  // namespace language
