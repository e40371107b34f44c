// Batches on their way from the thread that subdivides to the one that draws (paper §2.3).
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <vector>

#include "csgcore/subdivision.hpp"

namespace glrender {

class BatchQueue {
 public:
  struct Batch {
    std::vector<csgcore::Leaf> leaves;
    std::vector<csgcore::BlistTest> tests;
  };

  void push(const csgcore::LeafBatch& batch) {
    const std::lock_guard lock(mutex_);
    batches_.push_back(
        {{batch.leaves.begin(), batch.leaves.end()}, {batch.tests.begin(), batch.tests.end()}});
    ready_.notify_one();
  }
  void close(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    error_ = error;
    ready_.notify_one();
  }
  /// Waits for batches, and returns all that have come, joined into one. After close() it returns
  /// what is left, and then nothing, or rethrows the error that close() was given.
  std::optional<Batch> pop() {
    std::unique_lock lock(mutex_);
    ready_.wait(lock, [&] { return closed_ || !batches_.empty(); });
    if (batches_.empty()) {
      if (error_) std::rethrow_exception(error_);
      return std::nullopt;
    }
    Batch all = std::move(batches_.front());
    batches_.pop_front();
    for (; !batches_.empty(); batches_.pop_front()) {
      const Batch& next = batches_.front();
      const uint64_t base = all.tests.size();
      all.tests.insert(all.tests.end(), next.tests.begin(), next.tests.end());
      for (csgcore::Leaf leaf : next.leaves) {
        leaf.first_test += base;
        all.leaves.push_back(leaf);
      }
    }
    return all;
  }

 private:
  std::mutex mutex_;
  std::condition_variable ready_;
  std::deque<Batch> batches_;
  bool closed_ = false;
  std::exception_ptr error_;
};

}  // namespace glrender
