#include "values/object_memory.hpp"

#include <cstdlib>

namespace language {

thread_local ObjectMemory object_memory;

void check_text_size(size_t bytes) {
  if (object_memory.used + static_cast<int64_t>(bytes) > object_memory.limit)
    throw OutOfValueMemory();
}

void* allocate_object(size_t bytes) {
  check_text_size(bytes);
  void* block = std::malloc(bytes);
  if (!block) throw OutOfValueMemory();
  object_memory.used += static_cast<int64_t>(bytes);
  return block;
}

void free_object(void* block, size_t bytes) noexcept {
  object_memory.used -= static_cast<int64_t>(bytes);
  std::free(block);
}

}  // namespace language
