// Working memory that tasks borrow from each other.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace csgcore {

/// Keeps what is not in use. All threads may call it.
template <typename Memory>
class Pool {
 public:
  /// Returns what an earlier task has given back, as that task left it; null: nothing is free.
  std::unique_ptr<Memory> take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return nullptr;
    std::unique_ptr<Memory> memory = std::move(free_.back());
    free_.pop_back();
    return memory;
  }
  void give_back(std::unique_ptr<Memory> memory) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(memory));
  }
  /// All that was made, while none is in use.
  const std::vector<std::unique_ptr<Memory>>& all() const { return free_; }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Memory>> free_;
};

}  // namespace csgcore
