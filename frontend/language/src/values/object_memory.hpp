// The memory of the objects that values share, counted so that a design cannot take all there is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>

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
extern thread_local ObjectMemory object_memory;

/// Returns a block that is aligned for any object. Throws OutOfValueMemory.
void* allocate_object(size_t bytes);
/// Frees a block of allocate_object, of the size that it was asked for.
void free_object(void* block, size_t bytes) noexcept;

/// Throws OutOfValueMemory if a text of that size, made of values, would not fit.
void check_text_size(size_t bytes);

}  // namespace language
