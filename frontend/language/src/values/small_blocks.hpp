// Small blocks of memory: what most objects of values take. A thread keeps those that are freed in
// a list per size, so that most objects cost a few instructions to make and to free.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

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

/// The free blocks of one thread. Whole lists are exchanged with those of all threads: a block may
/// be freed by another thread than the one that took it.
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

}  // namespace language
