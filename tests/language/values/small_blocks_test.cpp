#include <gtest/gtest.h>

#include <set>
#include <thread>
#include <vector>

#include "values/object_memory.hpp"

namespace language {
namespace {

constexpr size_t kBytes = 240;  // a size that the other tests leave alone
constexpr int kMany = 3000;     // more than a thread keeps

std::vector<void*> take_many() {
  std::vector<void*> blocks;
  for (int i = 0; i < kMany; ++i) blocks.push_back(small_blocks.take(kBytes));
  return blocks;
}

void give_all(const std::vector<void*>& blocks) {
  for (void* const block : blocks) small_blocks.give(block, kBytes);
}

template <typename Work>
void in_thread(Work work) {
  std::thread(work).join();
}

// How many of `blocks` a new thread gets.
size_t taken_again(const std::vector<void*>& blocks) {
  size_t again = 0;
  in_thread([&] {
    const std::set<void*> before(blocks.begin(), blocks.end());
    const auto taken = take_many();
    for (void* const block : taken) again += before.count(block);
    give_all(taken);
  });
  return again;
}

TEST(SmallBlocks, AreTakenAgainBySize) {
  void* const block = small_blocks.take(kBytes);
  small_blocks.give(block, kBytes);
  void* const other = small_blocks.take(SmallBlocks::kStep);
  EXPECT_NE(other, block);
  EXPECT_EQ(small_blocks.take(kBytes - SmallBlocks::kStep + 1), block);
  small_blocks.give(block, kBytes);
  small_blocks.give(other, SmallBlocks::kStep);
}

TEST(SmallBlocks, OfAThreadThatEndsServeOthers) {
  std::vector<void*> blocks;
  in_thread([&] {
    blocks = take_many();
    EXPECT_EQ(std::set<void*>(blocks.begin(), blocks.end()).size(), size_t{kMany});
    give_all(blocks);
  });
  EXPECT_EQ(taken_again(blocks), size_t{kMany});
}

TEST(SmallBlocks, OfAThreadThatOnlyGivesServeOthers) {
  std::vector<void*> blocks;
  in_thread([&] { blocks = take_many(); });
  blocks.resize(kMany / 6);  // fewer than a thread keeps
  in_thread([&] { give_all(blocks); });
  EXPECT_EQ(taken_again(blocks), blocks.size());
}

TEST(SmallBlocks, ThatAnotherThreadFreesDoNotStayThere) {
  std::vector<void*> blocks;
  in_thread([&] { blocks = take_many(); });
  give_all(blocks);
  EXPECT_GE(taken_again(blocks), size_t{kMany} / 2);
}

}  // namespace
}  // namespace language
