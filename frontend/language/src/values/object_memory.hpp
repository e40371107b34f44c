// The memory of the objects that values share, counted so that a design cannot take all there is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "base/work_meter.hpp"
#include "values/small_blocks.hpp"

namespace language {

/// Thrown where a design's values would take more memory than they may.
class OutOfValueMemory : public std::bad_alloc {
 public:
  const char* what() const noexcept override { return "values take too much memory"; }
};

/// The bytes that the values of this thread's evaluation take, and may take. An evaluation sets
/// `used` to 0 when it begins; values of an earlier one that are freed later make it negative.
struct ObjectMemory {
  int64_t used = 0;
  int64_t limit = int64_t{4} << 30;
};
extern constinit thread_local ObjectMemory object_memory;

/// Throws OutOfValueMemory if a text of that size, made of values, would not fit.
inline void check_text_size(size_t bytes) {
  if (static_cast<int64_t>(bytes) > object_memory.limit - object_memory.used)
    throw OutOfValueMemory();
}

/// Returns a block that is aligned for any object, of more than 0 bytes. Throws OutOfValueMemory,
/// and Stopped: a block is filled.
inline void* allocate_object(size_t bytes) {
  constexpr size_t kBytesOfWork = 32;
  check_text_size(bytes);
  if (!SmallBlocks::holds(bytes)) count_work(bytes / kBytesOfWork);
  void* block = SmallBlocks::holds(bytes) ? small_blocks.take(bytes) : std::malloc(bytes);
  if (!block) throw OutOfValueMemory();
  object_memory.used += static_cast<int64_t>(bytes);
  return block;
}

/// Frees a block of allocate_object, of the size that it was asked for.
inline void free_object(void* block, size_t bytes) noexcept {
  object_memory.used -= static_cast<int64_t>(bytes);
  SmallBlocks::holds(bytes) ? small_blocks.give(block, bytes) : std::free(block);
}

/// Returns a block of another size that holds the bytes of a block, as many as both have; that
/// block is freed. Throws OutOfValueMemory, which leaves the block as it was.
void* resize_object(void* block, size_t bytes, size_t new_bytes);

/// Lets malloc keep some MiB of what the process frees. Without this it may give pages back at each
/// free and take them again at the next malloc, where large lists are copied over and over.
void keep_freed_memory();

}  // namespace language
