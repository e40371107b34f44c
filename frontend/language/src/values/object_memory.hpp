// The memory of the objects that values share, counted so that a design cannot take all there is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "base/evaluation_thread.hpp"

namespace language {

// An address sanitizer sees blocks that come from malloc one by one.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kListsSmallBlocks = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool kListsSmallBlocks = false;
#else
constexpr bool kListsSmallBlocks = true;
#endif
#else
constexpr bool kListsSmallBlocks = true;
#endif

/// Small blocks of memory: what most objects of values take. A thread keeps those that are freed in
/// a list per size, so that most objects cost a few instructions to make and to free. Whole lists
/// are exchanged with those of all threads: a block may be freed by another thread than the one
/// that took it.
class SmallBlocks {
 public:
  static constexpr size_t kStep = 16, kMostBytes = 256;
  /// Returns whether blocks of that size, which is above 0, are listed.
  static bool holds(size_t bytes) { return kListsSmallBlocks && bytes <= kMostBytes; }

  /// Returns a block that is aligned to kStep bytes; null: there is no memory.
  void* take(size_t bytes) {
    List& list = lists_[number_of(bytes)];
    if (!list.first && !refill(list, number_of(bytes))) return nullptr;
    Block* const block = list.first;
    list.first = block->next;
    ++list.room;
    return block;
  }
  /// Takes back a block of take(), of the size that it was asked for.
  void give(void* memory, size_t bytes) noexcept {
    List& list = lists_[number_of(bytes)];
    if (list.room <= 0) make_room(list, number_of(bytes));
    auto* const block = static_cast<Block*>(memory);
    block->next = list.first;
    list.first = block;
    --list.room;
  }
  /// Hands all lists over to other threads.
  void clear() noexcept;

 private:
  static constexpr int32_t kMostGiven = 1024;  // per size, then the list is handed over

  struct Block {
    Block* next;
    Block* next_list;  // of the first block of a list that no thread keeps
  };
  static_assert(sizeof(Block) <= kStep);
  struct List {
    Block* first = nullptr;
    int32_t room = 0;  // for blocks that are given, before the list is handed over
  };
  struct Depot;
  static Depot& depot();
  static size_t number_of(size_t bytes) { return (bytes - 1) / kStep; }
  static void clear_at_end();
  bool refill(List& list, size_t number);
  static void make_room(List& list, size_t number) noexcept;
  static void hand_over(List& list, size_t number) noexcept;

  std::array<List, kMostBytes / kStep> lists_{};
};
extern constinit thread_local SmallBlocks small_blocks;

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

/// Thrown where a text or a vector would become larger than it may; what() is the error that is
/// said.
class TooLarge : public std::bad_alloc {
 public:
  explicit TooLarge(const char* text) : text_(text) {}
  const char* what() const noexcept override { return text_; }

 private:
  const char* text_;
};

/// How deeply vectors may nest that an operator makes, or that are shown. OpenSCAD 2021.01 ends
/// without a word at some 14,000 to 28,000, where its stack does.
constexpr size_t kMostNesting = 30'000;

}  // namespace language
