#include "values/object_memory.hpp"

#include <algorithm>
#include <cstring>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace language {

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
